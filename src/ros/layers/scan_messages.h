// A laser's scan as rays in the map.
//
//   checkScan(*arrival.message);
//   checkScanPose(arrival.poses[0]);
//   const layers::ScanInMap scan = scanInMap(*arrival.message, arrival.poses[0], inf_clears);
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <Eigen/Geometry>

#include "layers/scan_layer.h"

namespace grid_path_planner::nodes {

// Throws InputError for a scan that cannot be meant: numbers that are not finite, ranges that do not lie between 0 and
// range_max, a ray for each of more than 20,000 angles, or none, or as many intensities. range_max may be +inf, as of
// pointcloud_to_laserscan where nobody set it.
void checkScan(const sensor_msgs::LaserScan& scan);

// Throws InputError for a pose that is not finite or farther than 1e6 m.
void checkScanPose(const Eigen::Isometry3d& map_from_scan);

// The rays of those that measured: a hit for a range above 0, from range_min on and below range_max; a free ray for +inf
// where `inf_clears`. The others say nothing: NaN, -inf, what is below range_min (sensor_msgs and REP 117), and what
// drivers and simulators send where nothing came back: range_max, more than that, 0. Each is put down into
// the map's plane. Preconditions: checkScan() and checkScanPose() take them; `map_from_scan` is of its
// stamp.
layers::ScanInMap scanInMap(const sensor_msgs::LaserScan& scan,
                            const Eigen::Isometry3d& map_from_scan, bool inf_clears);

}  // namespace grid_path_planner::nodes
