#include "ros/input/input_record.h"

#include <ros/console.h>

namespace grid_path_planner::nodes {

namespace {
const ros::WallDuration kLogPeriod(5.0);
}

void InputRecord::refuse(const std::string& reason) {
  reason_ = reason;
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (++refused_ > 1 && now - logged_ < kLogPeriod) return;
  logged_ = now;
  ROS_WARN_STREAM(name_ << " refused: " << reason);
}

}  // namespace grid_path_planner::nodes
