// Why the vehicle stands although something is flown: stop, a joystick, ~pause, a clock or a master that
// is gone.
//
//   FlightHold hold;
//   hold.notice(ros::Time::now(), true);                  // every tick
//   const bool flies = hold.why(master_timeout).empty();
//
// A joystick that takes over pauses the flight: it goes on by resume(), as a drive of navigate_path does.
#pragma once

#include <ros/time.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "ros/common/master/master_watch.h"

namespace grid_path_planner::nodes {

class FlightHold {
 public:
  struct Answer {
    bool done;
    std::string message;
  };

  void stop(bool is) { stopped_ = is; }
  void manual(bool is);
  // Of a flight; where there is none nothing is done.
  Answer pause(bool flies);
  Answer resume(bool flies);

  // ROS time is `now`. Whether a joystick has just paused the flight. A pause ends with its flight.
  bool notice(const ros::Time& now, bool flies);

  bool stopped() const { return stopped_; }
  // A joystick whose node was killed says nothing any more.
  bool isManual() const;
  // In a sentence; empty: it is not held.
  std::string why(double master_timeout) const;

 private:
  using Clock = std::chrono::steady_clock;

  const std::shared_ptr<MasterWatch> master_ = MasterWatch::shared();
  bool stopped_ = false;
  bool paused_ = false;
  std::optional<Clock::time_point> manual_;  // when a joystick said last that it commands
  ros::Time now_;
  Clock::time_point moved_ = Clock::now();  // when ROS time did last
};

}  // namespace grid_path_planner::nodes
