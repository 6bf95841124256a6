// What a drive reports: its events, and the names of states, statuses and waypoints in them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "grid_path_planner/following/path_follower.h"

namespace grid_path_planner::following {

class FollowEvents {
 public:
  void report(FollowEvent::Kind kind, int waypoint, const std::string& message);
  // The events since the last call, in order.
  std::vector<FollowEvent> take();

 private:
  std::vector<FollowEvent> events_;
};

// "waypoint 2 of 5" for index 1.
std::string waypointName(int waypoint, const path::Path& path);

}  // namespace grid_path_planner::following
