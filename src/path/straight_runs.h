// Polylines without the points that lie on a straight line: a path of steps between neighbouring cells
// has one for each step, and whoever measures it need not begin anew at each.
//
//   for (const Eigen::Vector2d& end : withoutCollinearPoints(points, 32.0)) use(end);
//
// Both ends stay, and so does every turn; a zero-length step counts as one. No segment of more than one
// step is longer than `longest`, and no point that is left out is farther from the rest than 2e-10 of
// `longest`.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace grid_path_planner::path {

std::vector<Eigen::Vector2d> withoutCollinearPoints(const std::vector<Eigen::Vector2d>& points,
                                                    double longest);

}  // namespace grid_path_planner::path
