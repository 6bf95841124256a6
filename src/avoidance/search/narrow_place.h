// Where a path squeezes through, and how wide that place is: said where it is too narrow.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/memory/open_space.h"

namespace grid_path_planner::avoidance {

struct NarrowPlace {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  double width = 0.0;  // m, between the points on both sides
};

// The narrowest place of a path that is nearer than `distance` to points on both sides; none: there is no such.
std::optional<NarrowPlace> narrowestPlace(const OpenSpace& space, const Points& path,
                                          double distance);

}  // namespace grid_path_planner::avoidance
