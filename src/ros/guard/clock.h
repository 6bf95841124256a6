// Times of ROS that are of any number, and a clock that has not come yet (node_time.h: one that goes back).
#pragma once

#include <ros/time.h>

#include "grid_path_planner/base/stop_token.h"

namespace grid_path_planner::nodes {

// s, that clocks of nodes may differ by: two machines, and two nodes at many times real time of which one has waited for a
// processor.
constexpr double kMostAhead = 10.0;

// From `from` to `to` in seconds. roscpp's difference of times throws beyond 2^31 s, as a stamp from
// 2106 or, from 2038 on, one of 0 has it.
double secondsBetween(const ros::Time& from, const ros::Time& to);

// The same time with less than 10^9 ns, which a message or /clock may have more of; the last that there is where that is
// beyond it. roscpp throws there, or compares what cannot be compared.
ros::Time normalized(const ros::Time& time);

// Whether there is a ROS time. With use_sim_time and no /clock yet there is none, every stamp would be 0, and every 5 s a
// warning says so.
bool hasTime();

// Waits until there is a ROS time. Throws Stopped.
void waitForClock(const base::StopToken& stop);

}  // namespace grid_path_planner::nodes
