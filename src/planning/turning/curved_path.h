// A path for a vehicle that cannot turn on the spot: its corners become curves of a least radius.
//
//   const CurvedPath curved = curvedPath(path, start_yaw, goal_yaw, {radius}, legal, stop);
//   if (curved.sharp == 0) drive(curved.path);
//
// Directed points are chosen on the path, half a radius apart, and joined by Dubins' curves (path/dubins.h) over up to
// twelve of them, which are tried against `legal`; of all such chains the shortest is taken. Guaranteed: the points lie on
// curves of at least that radius, which begin and end in the headings of the ends, but for `sharp` corners at which no
// curve was legal. Not guaranteed: that there are none where a vehicle could pass: this smooths one path, and no search for it
// knows of curves; it never drives backwards to turn.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::planning {

struct CurveLimits {
  double radius = 0.0;  // m
  double step = 0.1;    // rad, between the points of an arc
};

struct CurvedPath {
  path::Path path;                             // positions; no headings yet
  std::size_t sharp = 0;                       // corners that stay
  std::optional<Eigen::Vector2d> first_sharp;  // the first of them
};

// `start` and `goal`: directions in which the ends are passed; none: any. `legal` says whether a polyline may be driven, looking
// along it. Precondition: the path has two poses at least, no two of which coincide one after another. Throws Stopped.
CurvedPath curvedPath(const path::Path& path, std::optional<double> start,
                      std::optional<double> goal, const CurveLimits& limits,
                      const std::function<bool(const std::vector<Eigen::Vector2d>&)>& legal,
                      const base::StopToken& stop);

}  // namespace grid_path_planner::planning
