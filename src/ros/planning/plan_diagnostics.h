// The diagnostics of path_planner, published once a second: the map and the last planning.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include "ros/input/foreign_rules.h"
#include "ros/planning/planning_server.h"

namespace grid_path_planner::nodes {

class PlanDiagnostics {
 public:
  // `server` outlives this.
  PlanDiagnostics(ros::NodeHandle nh, ros::NodeHandle private_nh, PlanningServer& server);

 private:
  void reportMap(diagnostic_updater::DiagnosticStatusWrapper& status);
  void reportPlan(diagnostic_updater::DiagnosticStatusWrapper& status);

  PlanningServer& server_;
  MapFit map_fit_;
  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
};

}  // namespace grid_path_planner::nodes
