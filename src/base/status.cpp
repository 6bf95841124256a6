#include "grid_path_planner/base/status.h"

#include <cassert>

namespace grid_path_planner::base {

std::string_view toString(Status status) {
  switch (status) {
    case Status::FOUND:
      return "FOUND";
    case Status::START_OUTSIDE_MAP:
      return "START_OUTSIDE_MAP";
    case Status::GOAL_OUTSIDE_MAP:
      return "GOAL_OUTSIDE_MAP";
    case Status::START_OCCUPIED:
      return "START_OCCUPIED";
    case Status::GOAL_OCCUPIED:
      return "GOAL_OCCUPIED";
    case Status::UNREACHABLE:
      return "UNREACHABLE";
    case Status::TIMEOUT:
      return "TIMEOUT";
    case Status::CANCELLED:
      return "CANCELLED";
    case Status::NO_MAP:
      return "NO_MAP";
    case Status::TRANSFORM_ERROR:
      return "TRANSFORM_ERROR";
    case Status::INVALID_REQUEST:
      return "INVALID_REQUEST";
  }
  assert(false && "every status has a name");
  return "INVALID_REQUEST";
}

std::optional<Status> statusFromName(std::string_view name) {
  for (int i = 0; i <= static_cast<int>(Status::INVALID_REQUEST); ++i)
    if (toString(static_cast<Status>(i)) == name) return static_cast<Status>(i);
  return std::nullopt;
}

}  // namespace grid_path_planner::base
