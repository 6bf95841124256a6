// The outcome codes of mbf_msgs/GetPath by status.
#pragma once

#include <cstdint>

#include "grid_path_planner/base/status.h"

namespace grid_path_planner::nodes {

// Of those that all versions of mbf_msgs have: SUCCESS 0, FAILURE 50, CANCELED 51, INVALID_START 52,
// INVALID_GOAL 53, NO_PATH_FOUND 54, PAT_EXCEEDED 55, TF_ERROR 57, NOT_INITIALIZED 58.
std::uint32_t outcomeOf(base::Status status);

}  // namespace grid_path_planner::nodes
