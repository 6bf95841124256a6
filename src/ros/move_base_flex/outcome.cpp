#include "ros/move_base_flex/outcome.h"

namespace grid_path_planner::nodes {

using base::Status;
using mbf_msgs::GetPathResult;

std::uint32_t outcomeOf(Status status) {
  switch (status) {
    case Status::FOUND:
      return GetPathResult::SUCCESS;
    case Status::CANCELLED:
      return GetPathResult::CANCELED;
    case Status::START_OUTSIDE_MAP:
    case Status::START_OCCUPIED:
      return GetPathResult::INVALID_START;
    case Status::GOAL_OUTSIDE_MAP:
    case Status::GOAL_OCCUPIED:
      return GetPathResult::INVALID_GOAL;
    case Status::UNREACHABLE:
      return GetPathResult::NO_PATH_FOUND;
    case Status::TIMEOUT:
      return GetPathResult::PAT_EXCEEDED;
    case Status::TRANSFORM_ERROR:
      return GetPathResult::TF_ERROR;
    case Status::NO_MAP:
      return GetPathResult::NOT_INITIALIZED;
    case Status::INVALID_REQUEST:
      break;
  }
  return GetPathResult::FAILURE;
}

}  // namespace grid_path_planner::nodes
