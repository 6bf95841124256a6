#include "vehicle/commanded_velocity.h"

#include <algorithm>

namespace grid_path_planner::vehicle {

using base::BodyVelocity;

namespace {

constexpr double kLongestStep = 0.05;  // s

}  // namespace

void CommandedVelocity::advanceTo(double time) {
  if (time < time_ || time > time_ + kForgets) {
    state_ = {};
    followed_ = {};
    waiting_.clear();
    time_ = time;
  }
  while (time_ < time) {
    while (!waiting_.empty() && waiting_.front().followed_from <= time_) {
      followed_ = waiting_.front().command;
      waiting_.pop_front();
    }
    double end = std::min(time, time_ + kLongestStep);
    if (!waiting_.empty()) end = std::min(end, waiting_.front().followed_from);
    state_ = model_.advanced(state_, followed_, end - time_);
    time_ = end;
  }
}

void CommandedVelocity::sent(const BodyVelocity& command) {
  waiting_.push_back({time_ + model_.vehicle().dead_time, command});
}

std::vector<TimedCommand> CommandedVelocity::pending() const {
  std::vector<TimedCommand> pending;
  const double end = time_ + model_.vehicle().dead_time;
  double from = time_;
  BodyVelocity followed = followed_;
  for (const Sent& next : waiting_) {
    if (next.followed_from > from) pending.push_back({followed, next.followed_from - from});
    from = std::max(from, next.followed_from);
    followed = next.command;
  }
  if (end > from) pending.push_back({followed, end - from});
  return pending;
}

}  // namespace grid_path_planner::vehicle
