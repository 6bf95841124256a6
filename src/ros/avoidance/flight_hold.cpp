#include "ros/avoidance/flight_hold.h"

#include <utility>

namespace grid_path_planner::nodes {
namespace {

// By the wall clock.
constexpr std::chrono::milliseconds kClockStands(500);
constexpr std::chrono::milliseconds kManualHolds(2500);

}  // namespace

void FlightHold::stop(bool is) {
  const Lock lock(mutex_);
  stopped_ = is;
}

void FlightHold::manual(bool is) {
  const Lock lock(mutex_);
  manual_ = is ? std::make_optional(Clock::now()) : std::nullopt;
  paused_ = paused_ || (is && flies_);
}

bool FlightHold::stopped() const {
  const Lock lock(mutex_);
  return stopped_;
}

bool FlightHold::isManual() const {
  const Lock lock(mutex_);
  return joystickCommands();
}

bool FlightHold::joystickCommands() const {
  return manual_ && Clock::now() - *manual_ < kManualHolds;
}

FlightHold::Answer FlightHold::pause(bool flies) {
  const Lock lock(mutex_);
  if (!flies) return {false, "nothing to pause: nothing is flown"};
  noticed_ = true;
  if (std::exchange(paused_, true)) return {true, "paused already"};
  return {true, "paused until ~resume"};
}

FlightHold::Answer FlightHold::resume(bool flies) {
  const Lock lock(mutex_);
  if (!flies) return {false, "nothing to resume: nothing is flown"};
  if (joystickCommands()) return {false, "the joystick commands: let it go first"};
  noticed_ = false;
  return {true, std::exchange(paused_, false) ? "resumed" : "not paused"};
}

bool FlightHold::notice(const ros::Time& now, bool flies) {
  const Lock lock(mutex_);
  if (std::exchange(now_, now) != now) moved_ = Clock::now();
  flies_ = flies;
  paused_ = flies && (paused_ || joystickCommands());
  return !std::exchange(noticed_, paused_) && paused_;
}

std::string FlightHold::why(double master_timeout) const {
  const Lock lock(mutex_);
  if (stopped_) return "stopped by the topic stop";
  if (joystickCommands()) return "the joystick commands: paused until ~resume";
  if (paused_) return "paused until ~resume";
  if (Clock::now() - moved_ > kClockStands) return "ROS time stands still: no /clock comes";
  if (master_timeout > 0.0 && master_->silence() > master_timeout)
    return "the ROS master has not answered for longer than master_timeout";
  return "";
}

}  // namespace grid_path_planner::nodes
