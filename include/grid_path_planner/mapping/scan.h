// One depth frame as the 3-D map takes it: rays from where the sensor was to what it saw.
#pragma once

#include <octomap/octomap_types.h>

#include <Eigen/Core>
#include <vector>

namespace grid_path_planner::mapping {

// A point as OctoMap has it, in single precision.
inline octomap::point3d treePoint(const Eigen::Vector3d& point) {
  return {static_cast<float>(point.x()), static_cast<float>(point.y()),
          static_cast<float>(point.z())};
}

struct Scan {
  octomap::point3d origin;                   // m, frame of the tree
  std::vector<octomap::point3d> hits;        // m: surface points; the ray to each is free
  std::vector<octomap::point3d> clear_only;  // m: points filtered out; only the ray to each is free
};

}  // namespace grid_path_planner::mapping
