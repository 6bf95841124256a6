#include "ros/layers/scan_messages.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/input/frame_lookup.h"

namespace grid_path_planner::nodes {

using base::InputError;
using layers::Beam;
using layers::ScanInMap;

namespace {

constexpr std::size_t kMostBeams = 20000;
constexpr float kFarthest = 1e4F;  // m

float farthestOf(const sensor_msgs::LaserScan& scan) {
  return std::min(scan.range_max, kFarthest);
}

bool isHit(float measured, const sensor_msgs::LaserScan& scan) {
  return measured > 0.0F && measured >= scan.range_min && measured < farthestOf(scan);
}

}  // namespace

void checkScan(const sensor_msgs::LaserScan& scan) {
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment))
    throw InputError("its angles are not finite");
  if (!(scan.range_min >= 0.0F && scan.range_min < farthestOf(scan) &&
        (scan.range_max <= kFarthest || std::isinf(scan.range_max))))
    throw InputError("range_min and range_max must rise from 0 to 1e4 m, got " +
                     std::to_string(scan.range_min) + " and " + std::to_string(scan.range_max));
  if (scan.ranges.empty()) throw InputError("it has no ranges");
  if (scan.ranges.size() > kMostBeams)
    throw InputError("it has " + std::to_string(scan.ranges.size()) +
                     " ranges, more than 20000 are not taken");
  if (scan.intensities.size() > kMostBeams)  // they are not used, and wait for tf all the same
    throw InputError("it has " + std::to_string(scan.intensities.size()) +
                     " intensities, more than 20000 are not taken");
}

void checkScanPose(const geometry_msgs::TransformStamped& map_from_scan) {
  const auto& t = map_from_scan.transform.translation;
  const auto& q = map_from_scan.transform.rotation;
  const double largest = std::max({std::abs(t.x), std::abs(t.y), std::abs(t.z)});
  if (!(largest <= path::kLargestCoordinate) || !std::isfinite(q.x + q.y + q.z + q.w))
    throw InputError("tf has its sensor out of this world");
}

ScanInMap scanInMap(const sensor_msgs::LaserScan& message,
                    const geometry_msgs::TransformStamped& map_from_scan, bool inf_clears) {
  const Eigen::Isometry3d pose = isometryOf(map_from_scan.transform);
  ScanInMap scan;
  scan.time = message.header.stamp.toSec();
  scan.origin = pose.translation().head<2>();
  for (std::size_t i = 0; i < message.ranges.size(); ++i) {
    const float measured = message.ranges[i];
    const bool hit = isHit(measured, message);
    const bool free = inf_clears && std::isinf(measured) && measured > 0.0F;
    if (!hit && !free) continue;
    const double range = hit ? measured : farthestOf(message);
    const double angle = message.angle_min + static_cast<double>(i) * message.angle_increment;
    const Eigen::Vector3d end =
        pose * Eigen::Vector3d(range * std::cos(angle), range * std::sin(angle), 0.0);
    scan.beams.push_back({end.head<2>(), range, hit});
  }
  return scan;
}

}  // namespace grid_path_planner::nodes
