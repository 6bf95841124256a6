// The action `plan_path`: a way asked for by a program that wants to hear how it goes, or to
// cancel.
//
// One goal at a time: a new one cancels the one before. A cancelled goal is answered within 100 ms,
// whatever the planning thread is busy with. FOUND succeeds, CANCELLED is preempted, every other
// status is aborted with its sentence.
#pragma once

#include <actionlib/server/simple_action_server.h>
#include <ros/node_handle.h>

#include "grid_path_planner/PlanPathAction.h"
#include "ros/planning/planning_server.h"

namespace grid_path_planner::nodes {

class PlanAction {
 public:
  // `desk` outlives this, and its stop() comes before the destructor.
  PlanAction(const ros::NodeHandle& nh, PlanningServer& desk);

 private:
  void execute(const PlanPathGoalConstPtr& goal);
  bool answeredUncancelled(PlanTicket& inquiry);
  void finish(const PlanningResult& answer, const geometry_msgs::PoseStamped& goal);

  PlanningServer& desk_;
  actionlib::SimpleActionServer<PlanPathAction> server_;
};

}  // namespace grid_path_planner::nodes
