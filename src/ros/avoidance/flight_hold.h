// Why the vehicle stands although something is flown: stop, a joystick, ~pause, a clock or a master that
// is gone.
//
//   unsigned handovers = 0;
//   FlightHold hold([&](unsigned n) { handovers = n; });
//   const bool may_fly = hold.begin(handovers);           // with every route
//   hold.notice(ros::Time::now(), true);                  // with every plan
//   const bool flies = hold.why(master_timeout).empty();
//
// A joystick that takes over pauses the flight, however late the next plan is: it goes on by resume(), as a drive
// of navigate_path does. A pause outlives its flight. Thread-safe: what plans and what commands ask it both; no file,
// log or message is handled under its lock.
#pragma once

#include <ros/time.h>

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "ros/guard/master/master_watch.h"
#include "ros/input/manual_control.h"

namespace grid_path_planner::nodes {

class FlightHold {
 public:
  struct Answer {
    bool done;
    std::string message;
  };

  // `on_handover` is called where a joystick takes over, or lets go of, a vehicle that does not fly, by whoever calls
  // manual() or notice(); `handovers`: how often that was so far.
  explicit FlightHold(std::function<void(unsigned handovers)> on_handover);

  void stop(bool is);
  void manual(bool is);
  // Of the flight, or where nothing is flown of the next.
  Answer pause(bool flies);
  Answer resume(bool flies);
  // Of a flight that is cancelled by hand. Whether there was a pause.
  bool endPause();

  // A flight begins that was given when on_handover had said `handovers`, 0 before it had. Returns whether nobody has
  // taken the vehicle, or let go of it, since.
  bool begin(unsigned handovers);
  // ROS time is `now`. Whether a joystick has paused the flight since the last call.
  bool notice(const ros::Time& now, bool flies);

  bool stopped() const;
  bool isManual() const;
  // In a sentence; empty: it is not held.
  std::string why(double master_timeout) const;
  // As master_diagnostics.h has it.
  void diagnoseMaster(double master_timeout,
                      diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  using Clock = std::chrono::steady_clock;
  using Lock = std::lock_guard<std::mutex>;

  std::optional<unsigned> handOver();

  const std::function<void(unsigned)> on_handover_;
  const std::shared_ptr<MasterWatch> master_ = MasterWatch::shared();
  mutable std::mutex mutex_;
  bool stopped_ = false;
  bool flies_ = false;
  bool paused_ = false;
  bool noticed_ = false;  // that it is paused
  ManualControl joystick_;
  unsigned handovers_ = 0;
  ros::Time now_;
  Clock::time_point moved_ = Clock::now();  // when ROS time did last
};

}  // namespace grid_path_planner::nodes
