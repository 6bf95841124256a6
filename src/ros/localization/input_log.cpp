#include "ros/localization/input_log.h"

#include <ros/console.h>

namespace grid_path_planner::nodes {

void InputLog::refuse(localization::Source source, const std::string& reason) {
  Input& input = of(source);
  ++input.refused;
  if (input.refused == 1)
    ROS_WARN_STREAM(nameOf(source) << " refused: " << reason);
  else
    ROS_WARN_STREAM_THROTTLE(5.0, nameOf(source) << " refused: " << reason);
  input.reason = reason;
}

}  // namespace grid_path_planner::nodes
