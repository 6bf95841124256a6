// A timer of a node that goes on after what it called has thrown.
//
//   const ros::SteadyTimer timer = guardedTimer(nh, 0.05, [] { checkTime(); });
//
// roscpp sets a timer again after a call that returned, only: one std::bad_alloc would be the last tick of a node that
// otherwise goes on.
#pragma once

#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <functional>

namespace grid_path_planner::nodes {

// Calls `work` every `period` (s, steady clock) by the queue of `nh`, until it is stopped or destroyed. Guaranteed: an
// exception ends that call alone, with a line in the log.
ros::SteadyTimer guardedTimer(const ros::NodeHandle& nh, double period, std::function<void()> work);

// The same, once.
ros::SteadyTimer guardedTimerOnce(const ros::NodeHandle& nh, double delay,
                                  std::function<void()> work);

}  // namespace grid_path_planner::nodes
