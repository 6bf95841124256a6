// From the points of a sensor to a Scan: points in the frame of the tree, split into obstacles and
// others.
//
//   CloudFrames frames{map_from_sensor, base_from_map};
//   map.insert(filterCloud(points, frames, options).scan);
//
// A point outside the box of pointcloud_min/max, and one of the ground where filter_ground is set,
// is no obstacle, but the ray to it is free: it goes to Scan::clear_only. The box
// stands in the frame of the tree whether ground is filtered or not (octomap_server filters in the
// base frame then).
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "grid_path_planner/mapping/cloud_filter_options.h"
#include "grid_path_planner/mapping/scan.h"

namespace grid_path_planner::mapping {

// Where the sensor was.
struct CloudFrames {
  Eigen::Isometry3d map_from_sensor = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d base_from_map = Eigen::Isometry3d::Identity();  // with filter_ground
};

struct FilteredCloud {
  Scan scan;
  bool ground_missed = false;  // ground was to be filtered, and no plane was found
};

// `points`: finite, m, in the sensor's frame.
FilteredCloud filterCloud(std::vector<Eigen::Vector3d> points, const CloudFrames& frames,
                          const CloudFilterOptions& options);

}  // namespace grid_path_planner::mapping
