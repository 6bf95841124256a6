#include "ros/driving/follow_log.h"

#include <ros/console.h>

namespace grid_path_planner::nodes {
namespace {

using Kind = following::FollowEvent::Kind;

bool isWarning(Kind kind) {
  return kind == Kind::MISSED || kind == Kind::RETRY || kind == Kind::BLOCKED;
}

}  // namespace

void logEvent(const following::FollowEvent& event) {
  if (event.kind == Kind::REACHED)
    ROS_DEBUG_STREAM(event.message);
  else if (isWarning(event.kind))
    ROS_WARN_STREAM(event.message);
  else
    ROS_INFO_STREAM(event.message);
}

}  // namespace grid_path_planner::nodes
