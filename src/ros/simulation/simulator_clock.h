// The time of the simulation: how much of it is due by the wall clock, which ROS time a moment of it has, and /clock.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "ros/simulation/simulator_options.h"

namespace grid_path_planner::nodes {

class SimulatorClock {
 public:
  // Advertises /clock with publish_clock. `options`, as they are at any time, outlive this.
  SimulatorClock(ros::NodeHandle& nh, const SimulatorOptions& options) : options_(options) {
    if (options.publish_clock) publisher_ = nh.advertise<rosgraph_msgs::Clock>("/clock", 10);
  }

  // Time runs from now on.
  void start() {
    last_tick_ = ros::SteadyTime::now();
    last_tick_stamp_ = ros::Time::now();
  }
  // The time since the last call is due, at most what a late timer may catch up on: beyond it simulated time goes slower
  // instead of jumping.
  void addElapsed() {
    const ros::SteadyTime before = last_tick_;
    start();
    const double factor = options_.real_time_factor;
    const double most = std::max(kLongestDelay, 2.0 / options_.update_rate) * factor;
    pending_ = std::min(pending_ + (last_tick_ - before).toSec() * factor,
                        most + options_.vehicle.time_step);  // at slow factors a step is more
  }
  bool isStepDue() const { return pending_ >= options_.vehicle.time_step; }
  void takeStep() { pending_ -= options_.vehicle.time_step; }
  // No more than a step is due.
  void dropSteps() { pending_ = std::min(pending_, options_.vehicle.time_step); }

  // The ROS time of a simulated time (ns) that has passed; `now_ns`: that of the vehicle. Without a clock of its own a step
  // belongs to the time that it was due at, and not to that of the tick that has run several; 0 before ROS time has begun.
  ros::Time stampOf(std::int64_t time_ns, std::int64_t now_ns) const {
    if (options_.publish_clock)
      return ros::Time(options_.start_time) + ros::Duration().fromNSec(time_ns);
    const ros::Duration ago = ros::Duration().fromNSec(now_ns - time_ns) + ros::Duration(pending_);
    return last_tick_stamp_.toSec() > ago.toSec() ? last_tick_stamp_ - ago : ros::Time();
  }
  ros::Time now(std::int64_t now_ns) const {
    return options_.publish_clock ? stampOf(now_ns, now_ns) : ros::Time::now();
  }
  // As /clock, where that is ours. Returns whether it is not the time that was published last.
  bool publish(const ros::Time& stamp) {
    if (stamp == std::exchange(published_, stamp)) return false;
    rosgraph_msgs::Clock clock;
    clock.clock = stamp;
    if (options_.publish_clock) publisher_.publish(clock);
    return true;
  }

 private:
  static constexpr double kLongestDelay = 0.05;  // s of the wall clock

  const SimulatorOptions& options_;
  ros::Publisher publisher_;
  double pending_ = 0.0;  // s of simulated time that are due
  ros::SteadyTime last_tick_;
  ros::Time last_tick_stamp_;  // ROS time then
  ros::Time published_;
};

}  // namespace grid_path_planner::nodes
