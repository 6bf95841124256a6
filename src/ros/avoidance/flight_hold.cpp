#include "ros/avoidance/flight_hold.h"

#include <utility>

namespace grid_path_planner::nodes {
namespace {

// By the wall clock.
constexpr std::chrono::milliseconds kClockStands(500);
constexpr std::chrono::milliseconds kManualHolds(2500);

}  // namespace

void FlightHold::manual(bool is) {
  manual_ = is ? std::make_optional(Clock::now()) : std::nullopt;
}

bool FlightHold::isManual() const {
  return manual_ && Clock::now() - *manual_ < kManualHolds;
}

FlightHold::Answer FlightHold::pause(bool flies) {
  if (!flies) return {false, "nothing to pause: nothing is flown"};
  if (std::exchange(paused_, true)) return {true, "paused already"};
  return {true, "paused until ~resume"};
}

FlightHold::Answer FlightHold::resume(bool flies) {
  if (!flies) return {false, "nothing to resume: nothing is flown"};
  if (isManual()) return {false, "the joystick commands: let it go first"};
  return {true, std::exchange(paused_, false) ? "resumed" : "not paused"};
}

bool FlightHold::notice(const ros::Time& now, bool flies) {
  if (std::exchange(now_, now) != now) moved_ = Clock::now();
  const bool paused_before = std::exchange(paused_, flies && (paused_ || isManual()));
  return paused_ && !paused_before;
}

std::string FlightHold::why(double master_timeout) const {
  if (stopped_) return "stopped by the topic stop";
  if (isManual()) return "the joystick commands: paused until ~resume";
  if (paused_) return "paused until ~resume";
  if (Clock::now() - moved_ > kClockStands) return "ROS time stands still: no /clock comes";
  if (master_timeout > 0.0 && master_->silence() > master_timeout)
    return "the ROS master has not answered for longer than master_timeout";
  return "";
}

}  // namespace grid_path_planner::nodes
