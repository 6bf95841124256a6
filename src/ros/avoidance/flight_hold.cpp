#include "ros/avoidance/flight_hold.h"

#include <utility>

namespace grid_path_planner::nodes {

// Whoever commands may let the vehicle go before the next notice().
void FlightHold::begin(bool is_manual) {
  const Lock lock(mutex_);
  flies_ = true;
  paused_ = paused_ || is_manual;
}

void FlightHold::manual(bool is) {
  const Lock lock(mutex_);
  paused_ = paused_ || (is && flies_);
}

bool FlightHold::notice(bool flies, bool is_manual) {
  const Lock lock(mutex_);
  flies_ = flies;
  paused_ = paused_ || (flies && is_manual);
  return !std::exchange(noticed_, paused_) && paused_;
}

FlightHold::Answer FlightHold::pause(bool flies) {
  const Lock lock(mutex_);
  noticed_ = true;
  if (std::exchange(paused_, true)) return {true, "paused already"};
  return {true, flies ? "paused until ~resume"
                      : "nothing is flown: the next flight waits until it is resumed"};
}

FlightHold::Answer FlightHold::resume(bool flies, bool is_manual) {
  const Lock lock(mutex_);
  if (is_manual) return {false, "the joystick commands: let it go first"};
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

bool FlightHold::flies() const {
  const Lock lock(mutex_);
  return flies_;
}

bool FlightHold::paused() const {
  const Lock lock(mutex_);
  return paused_;
}

}  // namespace grid_path_planner::nodes
