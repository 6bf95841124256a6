// A laser's scan, as map_layers takes it.
#include "ros/layers/scan_messages.h"

#include <cmath>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfScans() {
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = "laser";
  scan.angle_min = -1.0F;
  scan.angle_increment = 0.5F;
  scan.range_max = 30.0F;
  scan.ranges = {1.0F, 2.0F, INFINITY, NAN, -INFINITY, 5.0F};
  return {bytesOf(scan)};
}

// A scan that is taken lies on the map layer as cells that are free, occupied or unknown.
FUZZ_TARGET(scan_message, seedsOfScans) {
  const auto message = messageOf<sensor_msgs::LaserScan>(input);
  if (!message) return;
  mayRefuse([&] {
    nodes::checkScan(*message);
    const layers::ScanInMap scan = nodes::scanInMap(*message, Eigen::Isometry3d::Identity(), true);
    for (const layers::Beam& beam : scan.beams)
      mustHold(beam.end.allFinite() && beam.range >= 0.0, "a ray ends somewhere");
    grid::OccupancyGrid map(grid::GridGeometry(40, 40, 0.5, {-5.0, -5.0, 0.0}), 0);
    layers::ScanLayer layer;
    layers::ChangedCells changed;
    layer.reset(map);
    layer.insert(scan, {}, map, changed);
    for (const std::int8_t value : map.values())
      mustHold(value == -1 || value == 0 || value == 100, "a cell was seen or not");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
