#include "grid_path_planner/avoidance/pilot.h"

namespace grid_path_planner::avoidance {

const char* toString(PilotStatus status) {
  switch (status) {
    case PilotStatus::IDLE:
      return "IDLE";
    case PilotStatus::FLYING:
      return "FLYING";
    case PilotStatus::ARRIVED:
      return "ARRIVED";
    case PilotStatus::BLOCKED:
      return "BLOCKED";
    case PilotStatus::STUCK:
      return "STUCK";
    case PilotStatus::NO_CLOUD:
      return "NO_CLOUD";
    case PilotStatus::TRANSFORM_ERROR:
      return "TRANSFORM_ERROR";
    case PilotStatus::GOAL_OCCUPIED:
      return "GOAL_OCCUPIED";
    case PilotStatus::CANCELLED:
      return "CANCELLED";
  }
  return "?";
}

}  // namespace grid_path_planner::avoidance
