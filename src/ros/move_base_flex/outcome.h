// The outcome codes of mbf_msgs/GetPath by status.
//
// By name: their numbers differ between versions of mbf_msgs (NO_PATH_FOUND is 54 in 0.3, 56 since
// BLOCKED_START and BLOCKED_GOAL came before it).
#pragma once

#include <mbf_msgs/GetPathResult.h>

#include <cstdint>

#include "grid_path_planner/base/status.h"

namespace grid_path_planner::nodes {

std::uint32_t outcomeOf(base::Status status);

}  // namespace grid_path_planner::nodes
