// The goal that path_planner plans for, its present path, and the start pose of the next goal. A
// result belongs to its goal: one for an older goal is dropped. A goal without a path stands: it is
// due again when the map has changed since its last planning began, or, where a transform was
// missing, when that is there; once in kRetryPeriod.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "grid_path_planner/base/status.h"
#include "grid_path_planner/path/path.h"
#include "grid_path_planner/planning/plan.h"
#include "ros/planning/planning_request.h"

namespace grid_path_planner::nodes {

struct GoalState {
  std::uint64_t id = 0;
  PlanningRequest request;
  ros::Time given;                             // of no other goal; 0 without a clock
  bool answered = false;                       // the start of the request holds until then
  base::Status status = base::Status::NO_MAP;  // of the last planning, once it is answered
  path::Path path;                             // empty where that found none
  unsigned path_settings = 0;                  // revision of the settings that it was planned with
};

class ActiveGoal {
 public:
  // The pose from which the next new goal starts.
  void setStart(const geometry_msgs::PoseStamped& start);
  // The start is forgotten, and the goal was given before all of the new time.
  void timeWentBack();

  // Replaces the goal and uses up the start. `now`: ROS time.
  void setGoal(const geometry_msgs::PoseStamped& goal, const ros::Time& now);
  std::optional<GoalState> goal() const;

  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kRetryPeriod{1};

  void mapChanged();
  // Whether a goal without a path is due again. `placed`: whether vehicle and goal have poses in the
  // frame of its empty path; asked where a transform was missing.
  bool retryIsDue(Time now, const std::function<bool(const GoalState&)>& placed) const;
  // The goal, whose planning begins `now`, on a map with all changes so far.
  std::optional<GoalState> beginPlanning(Time now);

  // An answer to it failed: there is no path, and a retry is due.
  void failed(std::uint64_t id);
  // If `id` is still the goal's: stores the answer and calls `publish` before any new goal is
  // accepted. Returns whether it was. `placed`: the goal that stands from now on, of one in a frame that moves.
  bool commit(std::uint64_t id, const planning::Plan& plan, unsigned path_settings,
              const std::function<void()>& publish,
              const std::optional<geometry_msgs::PoseStamped>& placed = {});

 private:
  mutable std::mutex mutex_;
  std::optional<geometry_msgs::PoseStamped> start_;
  std::optional<GoalState> goal_;
  std::uint64_t next_id_ = 1;
  bool map_changed_ = false;  // since the last planning began
  Time planned_;              // when that was
};

}  // namespace grid_path_planner::nodes
