#include "ros/adapters/outcome.h"

namespace grid_path_planner::nodes {

using base::Status;

std::uint32_t outcomeOf(Status status) {
  switch (status) {
    case Status::FOUND:
      return 0;
    case Status::CANCELLED:
      return 51;
    case Status::START_OUTSIDE_MAP:
    case Status::START_OCCUPIED:
      return 52;
    case Status::GOAL_OUTSIDE_MAP:
    case Status::GOAL_OCCUPIED:
      return 53;
    case Status::UNREACHABLE:
      return 54;
    case Status::TIMEOUT:
      return 55;
    case Status::TRANSFORM_ERROR:
      return 57;
    case Status::NO_MAP:
      return 58;
    case Status::INVALID_REQUEST:
      break;
  }
  return 50;
}

}  // namespace grid_path_planner::nodes
