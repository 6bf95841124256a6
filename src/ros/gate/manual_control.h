// Whether a joystick commands the vehicle, as the topic `manual_control` says, and when that changes.
//
//   ManualControl joystick;
//   const bool has_taken_over = joystick.hear(true);
//   const bool has_ended = joystick.expire();   // a few times a second: a node that was killed says nothing any more
//   const bool commands = joystick.commands();
//
// Not thread-safe.
#pragma once

#include <chrono>
#include <optional>

namespace grid_path_planner::nodes {

// Why a drive ends that a joystick has taken over, or let go of before it began.
inline constexpr char kTakenOver[] = "the joystick commands";

class ManualControl {
 public:
  // What a message says. Returns whether that is a change from what was told last, by this or expire().
  bool hear(bool commands) {
    const bool was = heard_.has_value();
    heard_ = commands ? std::make_optional(Clock::now()) : std::nullopt;
    return was != commands;
  }
  // Whether it has ended since the last call for want of a message.
  bool expire() {
    if (!heard_ || commands()) return false;
    heard_.reset();
    return true;
  }
  bool commands() const { return heard_ && Clock::now() - *heard_ < kTimeout; }

 private:
  using Clock = std::chrono::steady_clock;

  static constexpr std::chrono::milliseconds kTimeout{2500};

  std::optional<Clock::time_point> heard_;  // that it commands
};

}  // namespace grid_path_planner::nodes
