#include "avoidance/recovery.h"

#include <cmath>

namespace grid_path_planner::avoidance {
namespace {

constexpr double kExhausted = 2.0;      // s without any path
constexpr double kLongestAround = 6.0;  // times progress_timeout without coming nearer

}  // namespace

void Recovery::restart(double time, const Eigen::Vector3d& position, const Eigen::Vector3d& goal) {
  watch_.restart(time, position, goal);
  step_ = RecoveryStep::FLY;
  looked_ = planned_ = false;
  exhausted_since_.reset();
}

bool Recovery::noProgress(const State& state, const PilotOptions& options) const {
  if (!options.recover) return watch_.sinceMoved(state.time) > options.stuck_timeout;
  const bool exhausted = exhausted_since_ && state.time - *exhausted_since_ > kExhausted;
  return exhausted || watch_.sinceMoved(state.time) > options.progress_timeout ||
         watch_.sinceGained(state.time) > kLongestAround * options.progress_timeout;
}

// Until it has turned once; one that does not turn has had twice the time for it.
RecoveryStep Recovery::look(const State& state, const PilotOptions& options) {
  turned_ += std::remainder(state.yaw - *yaw_, 2.0 * M_PI);
  yaw_ = state.yaw;
  const bool over = state.time - looks_since_ > 4.0 * M_PI / options.max_yaw_rate;
  if (turned_ < 2.0 * M_PI && !over) return step_;
  watch_.excuse(state.time);
  exhausted_since_.reset();
  return step_ = RecoveryStep::FLY;
}

RecoveryStep Recovery::update(const State& state, const PilotOptions& options) {
  if (step_ == RecoveryStep::STUCK) return step_;
  if (step_ == RecoveryStep::LOOK) return look(state, options);
  if (watch_.update(state.time, state.position, state.goal)) looked_ = planned_ = false;
  if (!state.exhausted) exhausted_since_.reset();
  if (state.exhausted && !exhausted_since_) exhausted_since_ = state.time;
  if (!noProgress(state, options)) return step_;
  if (!options.recover || planned_) return step_ = RecoveryStep::STUCK;
  if (looked_) return RecoveryStep::PLAN;
  looked_ = true;
  turned_ = 0.0;
  yaw_ = state.yaw;
  looks_since_ = state.time;
  return step_ = RecoveryStep::LOOK;
}

void Recovery::hold(double seconds) {
  watch_.hold(seconds);
  looks_since_ += seconds;
  if (exhausted_since_) *exhausted_since_ += seconds;
}

void Recovery::planned(MapAnswer answer, double time) {
  planned_ = true;
  has_map_ = answer != MapAnswer::NO_MAP;
  if (answer != MapAnswer::PATH) step_ = RecoveryStep::STUCK;
  watch_.excuse(time);
  exhausted_since_.reset();
}

std::string Recovery::tried() const {
  if (planned_)
    return has_map_ ? "looked around, planned on the map" : "looked around; has no map to plan on";
  return looked_ ? "looked around" : "nothing";
}

}  // namespace grid_path_planner::avoidance
