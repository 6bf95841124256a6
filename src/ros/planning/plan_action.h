// The action `plan_path`: a path for a program that wants feedback while it is planned, or to cancel
// it.
//
// One goal at a time: a new one cancels the one before. A cancelled goal is answered within 100 ms,
// whatever the planning thread is doing. FOUND succeeds, CANCELLED is preempted, every other
// status is aborted with its sentence.
#pragma once

#include <actionlib/server/simple_action_server.h>
#include <ros/node_handle.h>

#include "grid_path_planner/PlanPathAction.h"
#include "ros/planning/planning_server.h"

namespace actionlib {

// With the stamps of action_topics.h.
template <>
void ActionServer<grid_path_planner::PlanPathAction>::initialize();

}  // namespace actionlib

namespace grid_path_planner::nodes {

class PlanAction {
 public:
  // `server` outlives this, and its stop() is called before the destructor.
  PlanAction(const ros::NodeHandle& nh, PlanningServer& server);

 private:
  void execute(const PlanPathGoalConstPtr& goal);
  void tryToGiveUp() noexcept;
  void answer(const PlanPathGoal& goal);
  bool answeredUncancelled(PlanTicket& ticket);
  void finish(const planning::Plan& plan, const path::Path& poses, const PlanStatistics& statistics,
              const planning::ViaPlan& via);

  PlanningServer& server_;
  actionlib::SimpleActionServer<PlanPathAction> action_;
};

}  // namespace grid_path_planner::nodes
