// A period of ROS time, asked for by a timer of another clock.
//
//   RosPeriod period;
//   period.begin(ros::Time::now());
//   const bool due = period.isOver(ros::Time::now(), 2.0);  // every 2 s of ROS time
//
// roscpp's own timers of ROS time end the process where /clock says 4294967295.9 s: they add their period to it.
#pragma once

#include <ros/time.h>

#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {

class RosPeriod {
 public:
  void begin(const ros::Time& now) { begin_ = now; }

  // Whether `seconds` have passed since the last that was over, or since begin(); the next begins then. Time that
  // goes back begins anew, and nothing is over.
  bool isOver(const ros::Time& now, double seconds) {
    if (now >= begin_ && secondsBetween(begin_, now) < seconds) return false;
    const bool went_back = now < begin_;
    begin_ = now;
    return !went_back;
  }

 private:
  ros::Time begin_;
};

}  // namespace grid_path_planner::nodes
