#include "ros/avoidance/flight_hold.h"

#include <utility>

#include "ros/guard/master/master_diagnostics.h"

namespace grid_path_planner::nodes {
namespace {

// By the wall clock.
constexpr std::chrono::milliseconds kClockStands(500);

}  // namespace

FlightHold::FlightHold(std::function<void(unsigned)> on_handover)
    : on_handover_(std::move(on_handover)) {}

void FlightHold::stop(bool is) {
  const Lock lock(mutex_);
  stopped_ = is;
}

void FlightHold::manual(bool is) {
  std::optional<unsigned> handovers;
  {
    const Lock lock(mutex_);
    if (joystick_.hear(is)) handovers = handOver();
    paused_ = paused_ || (is && flies_);
  }
  if (handovers) on_handover_(*handovers);
}

// None of a flight: it is paused, and resumed by hand.
std::optional<unsigned> FlightHold::handOver() {
  return flies_ ? std::nullopt : std::optional(++handovers_);
}

bool FlightHold::stopped() const {
  const Lock lock(mutex_);
  return stopped_;
}

bool FlightHold::isManual() const {
  const Lock lock(mutex_);
  return joystick_.commands();
}

FlightHold::Answer FlightHold::pause(bool flies) {
  const Lock lock(mutex_);
  noticed_ = true;
  if (std::exchange(paused_, true)) return {true, "paused already"};
  return {true, flies ? "paused until ~resume"
                      : "nothing is flown: the next flight waits until it is resumed"};
}

FlightHold::Answer FlightHold::resume(bool flies) {
  const Lock lock(mutex_);
  if (joystick_.commands()) return {false, "the joystick commands: let it go first"};
  noticed_ = false;
  if (std::exchange(paused_, false))
    return {true, flies ? "resumed" : "resumed: the next flight is flown"};
  if (!flies) return {false, "nothing to resume: nothing is flown"};
  return {true, "not paused"};
}

bool FlightHold::endPause() {
  const Lock lock(mutex_);
  return std::exchange(paused_, false);
}

bool FlightHold::begin(unsigned handovers) {
  const Lock lock(mutex_);
  flies_ = true;
  paused_ = paused_ || joystick_.commands();  // who may let it go before the next notice()
  return handovers == handovers_;
}

bool FlightHold::notice(const ros::Time& now, bool flies) {
  bool yields = false;
  std::optional<unsigned> handovers;
  {
    const Lock lock(mutex_);
    if (std::exchange(now_, now) != now) moved_ = Clock::now();
    flies_ = flies;
    if (joystick_.expire()) handovers = handOver();
    paused_ = paused_ || (flies && joystick_.commands());
    yields = !std::exchange(noticed_, paused_) && paused_;
  }
  if (handovers) on_handover_(*handovers);
  return yields;
}

std::string FlightHold::why(double master_timeout) const {
  const Lock lock(mutex_);
  if (stopped_) return "stopped by the topic stop";
  if (joystick_.commands()) return "the joystick commands: paused until ~resume";
  if (paused_) return "paused until ~resume";
  if (Clock::now() - moved_ > kClockStands) return "ROS time stands still: no /clock comes";
  if (master_timeout > 0.0 && master_->silence() > master_timeout)
    return "the ROS master has not answered for longer than master_timeout";
  return "";
}

void FlightHold::diagnoseMaster(double master_timeout,
                                diagnostic_updater::DiagnosticStatusWrapper& status) const {
  nodes::diagnoseMaster(master_->silence(), master_timeout, status);
}

}  // namespace grid_path_planner::nodes
