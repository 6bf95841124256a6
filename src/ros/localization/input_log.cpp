#include "ros/localization/input_log.h"

#include <ros/console.h>

namespace grid_path_planner::nodes {

namespace {
const ros::WallDuration kLogPeriod(5.0);
}

void InputLog::refuse(localization::Source source, const std::string& reason) {
  Input& input = of(source);
  input.reason = reason;
  ros::SteadyTime& logged = logged_[static_cast<std::size_t>(source)];
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (++input.refused > 1 && now - logged < kLogPeriod) return;
  logged = now;
  ROS_WARN_STREAM(nameOf(source) << " refused: " << reason);
}

}  // namespace grid_path_planner::nodes
