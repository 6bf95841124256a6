#include "ros/planning/active_goal.h"

#include <utility>

namespace grid_path_planner::nodes {

using path::Path;

void ActiveGoal::setStart(const geometry_msgs::PoseStamped& start) {
  std::lock_guard<std::mutex> lock(mutex_);
  start_ = start;
}

void ActiveGoal::forgetStart() {
  std::lock_guard<std::mutex> lock(mutex_);
  start_.reset();
  if (goal_) goal_->request.start.reset();
}

void ActiveGoal::setGoal(const geometry_msgs::PoseStamped& goal) {
  std::lock_guard<std::mutex> lock(mutex_);
  GoalState next;
  next.id = next_id_++;
  next.request.goal = goal;
  next.request.start = std::exchange(start_, std::nullopt);
  goal_ = std::move(next);
}

std::optional<GoalState> ActiveGoal::goal() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return goal_;
}

bool ActiveGoal::commit(std::uint64_t id, const Path& path, unsigned path_settings,
                        const std::function<void()>& publish) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (!goal_ || goal_->id != id) return false;
  goal_->answered = true;
  goal_->request.start.reset();  // every replan starts from tf
  goal_->path = path;
  goal_->path_settings = path_settings;
  publish();
  return true;
}

}  // namespace grid_path_planner::nodes
