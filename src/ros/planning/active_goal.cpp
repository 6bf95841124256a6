#include "ros/planning/active_goal.h"

#include <utility>

#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {

using planning::Plan;

namespace {

// `now`, or a nanosecond after `given` where time stands still.
ros::Time distinctFrom(const ros::Time& given, const ros::Time& now) {
  const ros::Time before = normalized(given);
  const bool stands = !now.isZero() && now <= before && before < ros::TIME_MAX &&
                      before.toSec() - now.toSec() < 1e-3;  // their difference as times may throw
  return stands ? ros::Time().fromNSec(before.toNSec() + 1) : now;
}

}  // namespace

void ActiveGoal::setStart(const geometry_msgs::PoseStamped& start) {
  std::lock_guard<std::mutex> lock(mutex_);
  start_ = start;
}

void ActiveGoal::timeWentBack() {
  std::lock_guard<std::mutex> lock(mutex_);
  start_.reset();
  if (!goal_) return;
  goal_->request.start.reset();
  goal_->given = ros::TIME_MIN;
}

void ActiveGoal::setGoal(const geometry_msgs::PoseStamped& goal, const ros::Time& now) {
  std::lock_guard<std::mutex> lock(mutex_);
  GoalState next;
  next.given = goal_ ? distinctFrom(goal_->given, now) : now;
  next.id = next_id_++;
  next.request.goal = goal;
  next.request.start = std::exchange(start_, std::nullopt);
  goal_ = std::move(next);
}

std::optional<GoalState> ActiveGoal::goal() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return goal_;
}

void ActiveGoal::mapChanged() {
  std::lock_guard<std::mutex> lock(mutex_);
  map_changed_ = true;
}

bool ActiveGoal::retryIsDue(Time now, const std::function<bool(const GoalState&)>& placed) const {
  std::unique_lock<std::mutex> lock(mutex_);
  if (!goal_ || !goal_->answered || !goal_->path.empty() || now - planned_ < kRetryPeriod)
    return false;
  if (map_changed_) return true;
  if (goal_->status != base::Status::TRANSFORM_ERROR) return false;
  const GoalState goal = *goal_;
  lock.unlock();
  return placed(goal);
}

std::optional<GoalState> ActiveGoal::beginPlanning(Time now) {
  std::lock_guard<std::mutex> lock(mutex_);
  map_changed_ = false;
  planned_ = now;
  return goal_;
}

void ActiveGoal::failed(std::uint64_t id) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (!goal_ || goal_->id != id) return;
  goal_->answered = map_changed_ = true;
  goal_->path = {};
}

bool ActiveGoal::commit(std::uint64_t id, const Plan& plan, unsigned path_settings,
                        const std::function<void()>& publish,
                        const std::optional<geometry_msgs::PoseStamped>& placed) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (!goal_ || goal_->id != id) return false;
  goal_->answered = true;
  goal_->request.start.reset();  // every replan starts from tf
  if (placed) goal_->request.goal = *placed;
  goal_->status = plan.status;
  goal_->path = plan.path;
  goal_->path_settings = path_settings;
  publish();
  return true;
}

}  // namespace grid_path_planner::nodes
