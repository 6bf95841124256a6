#include "grid_path_planner/mapping/cloud_filter.h"

#include <string>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"
#include "mapping/insertion/ground_filter.h"

namespace grid_path_planner::mapping {

using base::checkOptionLimits;
using base::decimalText;
using base::InputError;

namespace {

bool inBox(const Eigen::Vector3d& p, const CloudFilterOptions& o) {
  return p.x() >= o.min_x && p.x() <= o.max_x && p.y() >= o.min_y && p.y() <= o.max_y &&
         p.z() >= o.min_z && p.z() <= o.max_z;
}

void checkSide(const std::string& axis, double min, double max) {
  if (min <= max) return;
  throw InputError("pointcloud_min_" + axis + " must not be above pointcloud_max_" + axis +
                   ", got " + decimalText(min) + " and " + decimalText(max));
}

GroundSplit groundOf(const std::vector<Eigen::Vector3d>& points,
                     const Eigen::Isometry3d& base_from_map, const GroundFilterOptions& options) {
  std::vector<Eigen::Vector3d> in_base;
  in_base.reserve(points.size());
  for (const Eigen::Vector3d& point : points) in_base.push_back(base_from_map * point);
  return splitGround(in_base, options);
}

}  // namespace

void checkCloudFilterOptions(const CloudFilterOptions& o) {
  checkOptionLimits(o);
  checkSide("x", o.min_x, o.max_x);
  checkSide("y", o.min_y, o.max_y);
  checkSide("z", o.min_z, o.max_z);
}

FilteredCloud filterCloud(std::vector<Eigen::Vector3d> points, const CloudFrames& frames,
                          const CloudFilterOptions& options) {
  for (Eigen::Vector3d& point : points) point = frames.map_from_sensor * point;
  GroundSplit ground;
  if (options.filter_ground) ground = groundOf(points, frames.base_from_map, options.ground);
  FilteredCloud filtered;
  filtered.ground_missed = options.filter_ground && !points.empty() && !ground.plane_found;
  filtered.scan.origin = treePoint(frames.map_from_sensor.translation());
  filtered.scan.hits.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_ground = options.filter_ground && ground.is_ground[i];
    auto& kind =
        !is_ground && inBox(points[i], options) ? filtered.scan.hits : filtered.scan.clear_only;
    kind.push_back(treePoint(points[i]));
  }
  return filtered;
}

}  // namespace grid_path_planner::mapping
