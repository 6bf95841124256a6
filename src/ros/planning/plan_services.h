// The services of path_planner: ~make_plan, ~compare_plans, ~explain_plan, ~save_waypoints.
//
// Threads of their own call them, two for plans and one for files, so that a request that takes long
// delays neither the node's other callbacks nor the arrival of a second request. A client that closes
// its connection cancels what it asked for.
#pragma once

#include <nav_msgs/GetPlan.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>

#include <string>
#include <vector>

#include "grid_path_planner/ComparePlans.h"
#include "grid_path_planner/ExplainPlan.h"
#include "grid_path_planner/SaveWaypoints.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/incoming/service_caller.h"
#include "ros/planning/planning_server.h"

namespace grid_path_planner::nodes {

class PlanServices {
 public:
  // `server` outlives this, and its stop() is called before the destructor.
  PlanServices(ros::NodeHandle private_nh, PlanningServer& server);
  ~PlanServices();

 private:
  using MakePlan = ros::ServiceEvent<nav_msgs::GetPlan::Request, nav_msgs::GetPlan::Response>;
  using Comparison = ros::ServiceEvent<ComparePlans::Request, ComparePlans::Response>;

  using Why = ros::ServiceEvent<ExplainPlan::Request, ExplainPlan::Response>;

  bool makePlan(MakePlan& call);
  bool comparePlans(Comparison& call);
  void compare(const std::vector<PlanningRequest>& requests, const ServiceCaller& caller,
               ComparePlans::Response& response);
  bool explainPlan(Why& call);
  bool saveWaypoints(SaveWaypoints::Request& request, SaveWaypoints::Response& response);

  PlanningServer& server_;
  ros::CallbackQueue queue_, file_queue_;
  GuardedQueue guarded_{queue_}, guarded_files_{file_queue_};
  ros::ServiceServer make_plan_;
  ros::ServiceServer compare_plans_;
  ros::ServiceServer explain_plan_;
  ros::ServiceServer save_waypoints_;
  ros::AsyncSpinner spinner_, file_spinner_;
};

}  // namespace grid_path_planner::nodes
