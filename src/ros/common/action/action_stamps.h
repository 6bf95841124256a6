// Goals and cancels of an action in the order in which they come, whatever their stamps say.
//
//   ActionStamps stamps;
//   goal_id.stamp = stamps.ofGoal(ros::Time::now());
//
// actionlib orders goals by the stamps that their senders give. One goal stamped 2^32 - 1 s makes a
// SimpleActionServer refuse every later one, as does /clock that begins anew; a cancel stamped so
// cancels every later one; and where its id is unknown, no status is published any more.
#pragma once

#include <ros/time.h>

#include <algorithm>

namespace grid_path_planner::nodes {

class ActionStamps {
 public:
  // Above all that were given out before; now, where that is.
  ros::Time ofGoal(const ros::Time& now) {
    last_ = std::max(now, last_ + ros::Duration(0, 1));
    return last_;
  }
  // One that is ahead means everything that has come. 0 stays: it means the goal of the cancel's id.
  ros::Time ofCancel(const ros::Time& given, const ros::Time& now) {
    return given > std::max(now, last_) ? ofGoal(now) : given;
  }

 private:
  ros::Time last_;
};

}  // namespace grid_path_planner::nodes
