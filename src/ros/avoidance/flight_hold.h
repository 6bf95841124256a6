// Whether what is flown is paused: by ~pause, or by a joystick that took over.
//
//   FlightHold hold;
//   hold.begin(gate.isManual());                          // with every route
//   hold.manual(true);                                    // as a joystick says
//   const bool yields = hold.notice(true, gate.isManual());  // with every plan
//   const bool flies = !hold.paused();
//
// A joystick that takes over pauses the flight, however late the next plan is: it goes on by resume(), as a drive
// of navigate_path does. A pause outlives its flight. Thread-safe: what plans and what commands ask it both; no file,
// log or message is handled under its lock.
#pragma once

#include <mutex>
#include <string>

namespace grid_path_planner::nodes {

class FlightHold {
 public:
  struct Answer {
    bool done;
    std::string message;
  };

  // `is_manual`: whether a joystick commands.
  void begin(bool is_manual);
  void manual(bool is);
  // Whether a joystick has paused the flight since the last call.
  bool notice(bool flies, bool is_manual);
  // Of the flight, or where nothing is flown of the next.
  Answer pause(bool flies);
  Answer resume(bool flies, bool is_manual);
  // Of a flight that is cancelled by hand. Whether there was a pause.
  bool endPause();

  bool flies() const;
  bool paused() const;

 private:
  using Lock = std::lock_guard<std::mutex>;

  mutable std::mutex mutex_;
  bool flies_ = false;
  bool paused_ = false;
  bool noticed_ = false;  // that it is paused
};

}  // namespace grid_path_planner::nodes
