#include "grid_path_planner/mapping/map_model.h"

#include <chrono>
#include <utility>

#include "base/seconds_since.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::mapping {

using base::decimalText;
using base::InputError;
using base::ReadLimits;
using base::StopToken;
using grid::OccupancyGrid;
using grid::writeMapServerFile;

namespace {

const ProjectedMapOptions& checked(const ProjectedMapOptions& options) {
  checkProjectedMapOptions(options);
  return options;
}

OctreeMap mapOf(const ProjectedMapOptions& options, const std::string& begin_with,
                const StopToken& stop) {
  OctreeMap map(options.octree);
  if (!begin_with.empty())
    map.load(begin_with, ReadLimits::none(stop));
  else if (!options.filename.empty())
    map.load(options.filename, {options.reading, stop});
  return map;
}

}  // namespace

MapModel::MapModel(const ProjectedMapOptions& options, const std::string& begin_with,
                   const StopToken& stop)
    : options_(checked(options)),
      map_(mapOf(options, begin_with, stop)),
      projection_(map_.options().resolution, projectionOptions(options)) {
  asked_resolution_ = options_.octree.resolution = map_.options().resolution;
}

void MapModel::setOptions(const ProjectedMapOptions& asked, const StopToken& stop) {
  checkProjectedMapOptions(asked);
  ProjectedMapOptions options = asked;
  const double resolution = options_.octree.resolution;
  if (asked.octree.resolution != asked_resolution_ && asked.octree.resolution != resolution)
    throw InputError("resolution cannot be changed while the node runs, it is " +
                     decimalText(resolution) + " m");
  options.octree.resolution = resolution;
  if (options.frame_id != options_.frame_id)
    throw InputError("frame_id cannot be changed while the node runs, it is " + options_.frame_id);
  if (options.latch != options_.latch)
    throw InputError("latch cannot be changed while the node runs");
  if (options.filename != options_.filename && !options.filename.empty()) {
    replaceMap(options, stop);
  } else {
    projection_.setOptions(projectionOptions(options));
    map_.setOptions(options.octree);
    options_ = options;
  }
  asked_resolution_ = asked.octree.resolution;
  ++revision_;
}

// By the map of another file.
void MapModel::replaceMap(const ProjectedMapOptions& options, const StopToken& stop) {
  MapModel other(options, "", stop);
  options_ = other.options_;
  map_ = std::move(other.map_);
  projection_ = std::move(other.projection_);
  change_ = {true, {}};
}

MapModel::Inserted MapModel::insert(std::vector<Eigen::Vector3d> points,
                                    const CloudFrames& frames) {
  const auto start = std::chrono::steady_clock::now();
  Inserted inserted;
  inserted.points = points.size();
  const FilteredCloud cloud = filterCloud(std::move(points), frames, options_.cloud);
  inserted.ground_missed = cloud.ground_missed;
  ++revision_;  // also of a map that is changed in part, for want of memory
  inserted.left_out = map_.insert(cloud.scan);
  inserted.map_is_full = map_.isFull();
  projection_.setSensor(cloud.scan.origin.x(), cloud.scan.origin.y());
  inserted.seconds = base::secondsSince(start);
  return inserted;
}

void MapModel::reset() {
  ++revision_;
  map_.reset();
}

void MapModel::clearBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  ++revision_;
  map_.clearBox(treePoint(low), treePoint(high));
}

void MapModel::decay(double seconds) {
  ++revision_;
  map_.decay(seconds);
}

const OccupancyGrid& MapModel::grid() {
  const ProjectionChange change = projection_.update(map_.bricks());
  ++projections_;
  change_.geometry = change_.geometry || change.geometry;
  change_.cells = change_.cells.hull(change.cells);
  return projection_.grid();
}

double MapModel::areaLeftOut() const {
  const double side = 8.0 * map_.options().resolution;
  return static_cast<double>(projection_.columnsLeftOut()) * side * side;
}

ProjectionChange MapModel::takeChange() {
  return std::exchange(change_, {});
}

void MapModel::saveMap(const base::OutputFile& file) {
  writeMapServerFile(file, grid());
}

}  // namespace grid_path_planner::mapping
