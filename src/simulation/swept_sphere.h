// A sphere that moves along a segment through a world of surfaces (swept-sphere collision).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::simulation {

struct SweptSphere {
  Eigen::Vector3d end;                    // of the sphere's centre
  std::optional<NearestSurface> touched;  // the surface that stops it; none: it reaches the target
};

// How far a sphere of `radius` metres gets from `from` towards `to`: a surface is at most a billionth
// of a metre inside the sphere where it stops. A sphere that a surface intersects at the start, where
// it has been put, is not stopped by anything.
SweptSphere sweptSphere(const World& world, double radius, const Eigen::Vector3d& from,
                        const Eigen::Vector3d& to);

}  // namespace grid_path_planner::simulation
