// How a planning request ended. The same names stand in C++, in messages and on the command line.
//
// A status is an *answer*. A bad caller or a bad file is an InputError (base/errors.h), and a
// bug of our own an assert.
#pragma once

#include <optional>
#include <string_view>

namespace grid_path_planner::base {

enum class Status {
  FOUND,
  START_OUTSIDE_MAP,
  GOAL_OUTSIDE_MAP,
  START_OCCUPIED,
  GOAL_OCCUPIED,
  UNREACHABLE,
  TIMEOUT,
  CANCELLED,
  NO_MAP,
  TRANSFORM_ERROR,
  INVALID_REQUEST,
};

// The enumerator's own name, e.g. "START_OCCUPIED".
std::string_view toString(Status status);
// None for any other name. Where messages and files bring names, this is how they become a status.
std::optional<Status> statusFromName(std::string_view name);

}  // namespace grid_path_planner::base
