// Which points of a scan are ground: a plane found by RANSAC.
//
//   const GroundSplit split = splitGround(points, options);  // points in the vehicle's base frame
//
// octomap_server's rule: the plane must lean less than `angle` from level and pass within
// `plane_distance` of the base frame's origin (a table does not); the points within `distance` of
// it are ground. Where there is no such plane, the points within plane_distance of z = 0 are.
//
// Guaranteed: deterministic; the same points give the same split. Not guaranteed: the plane with
// the most points (Fischler and Bolles 1981: very likely it is).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "grid_path_planner/mapping/cloud_filter.h"

namespace grid_path_planner::mapping {

struct GroundSplit {
  std::vector<bool> is_ground;  // one a point
  bool plane_found = false;
};

// Finite points in metres, z up. Fewer than 50 points: none of them is ground.
GroundSplit splitGround(const std::vector<Eigen::Vector3d>& points,
                        const GroundFilterOptions& options);

}  // namespace grid_path_planner::mapping
