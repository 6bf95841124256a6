// The traits that all any-angle planners have in common.
#pragma once

#include "grid_path_planner/planners/planner.h"

namespace grid_path_planner::planners {

inline PlannerTraits anyAngleTraits(const char* name) {
  PlannerTraits traits{name};
  traits.four_connected = false;
  traits.unit_diagonals = false;
  traits.any_angle = true;
  return traits;
}

}  // namespace grid_path_planner::planners
