// Why the vehicle stands although something is flown: stop, a joystick, ~pause, a clock or a master that
// is gone.
//
//   FlightHold hold;
//   hold.notice(ros::Time::now(), true);                  // with every plan
//   const bool flies = hold.why(master_timeout).empty();
//
// A joystick that takes over pauses the flight, however late the next plan is: it goes on by resume(), as a drive
// of navigate_path does. Thread-safe: what plans and what commands ask it both; no file, log or message is
// handled under its lock.
#pragma once

#include <ros/time.h>

#include <chrono>
#include <memory>
#include <mutex>
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

  void stop(bool is);
  void manual(bool is);
  // Of a flight; where there is none nothing is done.
  Answer pause(bool flies);
  Answer resume(bool flies);

  // ROS time is `now`. Whether a joystick has paused the flight since the last call. A pause ends with its
  // flight.
  bool notice(const ros::Time& now, bool flies);

  bool stopped() const;
  // A joystick whose node was killed says nothing any more.
  bool isManual() const;
  // In a sentence; empty: it is not held.
  std::string why(double master_timeout) const;

 private:
  using Clock = std::chrono::steady_clock;
  using Lock = std::lock_guard<std::mutex>;

  bool joystickCommands() const;

  const std::shared_ptr<MasterWatch> master_ = MasterWatch::shared();
  mutable std::mutex mutex_;
  bool stopped_ = false;
  bool flies_ = false;
  bool paused_ = false;
  bool noticed_ = false;                     // that it is paused
  std::optional<Clock::time_point> manual_;  // when a joystick said last that it commands
  ros::Time now_;
  Clock::time_point moved_ = Clock::now();  // when ROS time did last
};

}  // namespace grid_path_planner::nodes
