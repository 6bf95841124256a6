// A sphere on a straight way through a world of surfaces.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::simulation {

struct SphereWay {
  Eigen::Vector3d end;                    // where the sphere's centre gets to
  std::optional<NearestSurface> touched;  // what stops it there; nothing: it gets all the way
};

// How far a sphere of `radius` metres gets from `from` towards `to`: it stops a billionth of a
// metre before a surface would cut it, at the latest. A sphere that a surface cuts already, since
// it was put there, is not held by anything.
SphereWay followWay(const World& world, double radius, const Eigen::Vector3d& from,
                    const Eigen::Vector3d& to);

}  // namespace grid_path_planner::simulation
