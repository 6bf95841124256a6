// Closest point on a triangle: Christer Ericson, Real-Time Collision Detection (2005),
// section 5.1.5.
#pragma once

#include <Eigen/Core>

namespace grid_path_planner::simulation {

// The point of the triangle a, b, c that is nearest to p; degenerate triangles count as the segment
// or point that they are.
Eigen::Vector3d closestPointOnTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                       const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace grid_path_planner::simulation
