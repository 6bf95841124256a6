// The goal that path_planner is after, the path it has for it, and the pose that the next one
// starts from. A result belongs to its goal: what comes for an older one is dropped.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "ros/planning/planning_backend.h"

namespace grid_path_planner::nodes {

struct GoalState {
  std::uint64_t id = 0;
  PlanningRequest question;
  bool answered = false;       // the start of the question holds until then
  path::Path path;             // empty where the last answer was none
  unsigned path_settings = 0;  // revision of the settings that it was planned with
};

class ActiveGoal {
 public:
  // A pose for the next new goal to start from.
  void setStart(const geometry_msgs::PoseStamped& start);
  void forgetStart();

  // Takes the place of the goal before, and the start with it.
  void setGoal(const geometry_msgs::PoseStamped& goal);
  std::optional<GoalState> goal() const;

  // If `id` is still the goal's: keeps the path and calls `tell` before any new goal is taken.
  // Returns whether it was.
  bool commit(std::uint64_t id, const path::Path& path, unsigned path_settings,
              const std::function<void()>& tell);

 private:
  mutable std::mutex mutex_;
  std::optional<geometry_msgs::PoseStamped> start_;
  std::optional<GoalState> goal_;
  std::uint64_t next_id_ = 1;
};

}  // namespace grid_path_planner::nodes
