#include "following/follow_events.h"

#include <utility>

namespace grid_path_planner::following {

const char* toString(FollowState state) {
  switch (state) {
    case FollowState::IDLE:
      return "idle";
    case FollowState::DRIVING:
      return "driving";
    case FollowState::PAUSED:
      return "paused";
    case FollowState::BLOCKED:
      return "blocked";
    case FollowState::ARRIVED:
      return "arrived";
    case FollowState::CANCELLED:
      return "cancelled";
    case FollowState::FAILED:
      return "failed";
  }
  return "?";
}

const char* toString(DriveStatus status) {
  switch (status) {
    case DriveStatus::NONE:
      return "NONE";
    case DriveStatus::ARRIVED:
      return "ARRIVED";
    case DriveStatus::CANCELLED:
      return "CANCELLED";
    case DriveStatus::BLOCKED:
      return "BLOCKED";
    case DriveStatus::TF_STALE:
      return "TF_STALE";
    case DriveStatus::NO_PROGRESS:
      return "NO_PROGRESS";
    case DriveStatus::MISSED_WAYPOINT:
      return "MISSED_WAYPOINT";
    case DriveStatus::INVALID_POSE:
      return "INVALID_POSE";
    case DriveStatus::INVALID_REQUEST:
      return "INVALID_REQUEST";
    case DriveStatus::POSE_JUMP:
      return "POSE_JUMP";
    case DriveStatus::WRONG_DRIVE:
      return "WRONG_DRIVE";
  }
  return "?";
}

std::optional<DriveStatus> driveStatusFromName(std::string_view name) {
  for (int i = 0; i <= static_cast<int>(DriveStatus::WRONG_DRIVE); ++i)
    if (toString(static_cast<DriveStatus>(i)) == name) return static_cast<DriveStatus>(i);
  return std::nullopt;
}

void FollowEvents::report(FollowEvent::Kind kind, int waypoint, const std::string& message) {
  events_.push_back({kind, waypoint, message});
}

std::vector<FollowEvent> FollowEvents::take() {
  return std::exchange(events_, {});
}

std::string waypointName(int waypoint, const path::Path& path) {
  return "waypoint " + std::to_string(waypoint + 1) + " of " + std::to_string(path.poses.size());
}

}  // namespace grid_path_planner::following
