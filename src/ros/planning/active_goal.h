// The goal that path_planner plans for, its present path, and the start pose of the next goal. A
// result belongs to its goal: one for an older goal is dropped.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "grid_path_planner/path/path.h"
#include "ros/planning/planning_request.h"

namespace grid_path_planner::nodes {

struct GoalState {
  std::uint64_t id = 0;
  PlanningRequest request;
  bool answered = false;       // the start of the request holds until then
  path::Path path;             // empty where the last planning found none
  unsigned path_settings = 0;  // revision of the settings that it was planned with
};

class ActiveGoal {
 public:
  // The pose from which the next new goal starts.
  void setStart(const geometry_msgs::PoseStamped& start);
  void forgetStart();

  // Replaces the goal and uses up the start.
  void setGoal(const geometry_msgs::PoseStamped& goal);
  std::optional<GoalState> goal() const;

  // If `id` is still the goal's: stores the path and calls `publish` before any new goal is accepted.
  // Returns whether it was.
  bool commit(std::uint64_t id, const path::Path& path, unsigned path_settings,
              const std::function<void()>& publish);

 private:
  mutable std::mutex mutex_;
  std::optional<geometry_msgs::PoseStamped> start_;
  std::optional<GoalState> goal_;
  std::uint64_t next_id_ = 1;
};

}  // namespace grid_path_planner::nodes
