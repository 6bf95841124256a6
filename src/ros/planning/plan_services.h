// The services of path_planner: ~make_plan, ~compare_plans, ~save_waypoints.
//
// Two threads of their own call them, so that a request that takes long delays neither the node's
// other callbacks nor the arrival of a second request.
#pragma once

#include <nav_msgs/GetPlan.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>

#include "grid_path_planner/ComparePlans.h"
#include "grid_path_planner/SaveWaypoints.h"
#include "ros/common/guarded_queue.h"
#include "ros/planning/planning_server.h"

namespace grid_path_planner::nodes {

class PlanServices {
 public:
  // `server` outlives this, and its stop() is called before the destructor.
  PlanServices(ros::NodeHandle private_nh, PlanningServer& server);
  ~PlanServices();

 private:
  bool makePlan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response);
  bool comparePlans(ComparePlans::Request& request, ComparePlans::Response& response);
  bool saveWaypoints(SaveWaypoints::Request& request, SaveWaypoints::Response& response);

  PlanningServer& server_;
  ros::CallbackQueue queue_;
  GuardedQueue guarded_{queue_};
  ros::ServiceServer make_plan_;
  ros::ServiceServer compare_plans_;
  ros::ServiceServer save_waypoints_;
  ros::AsyncSpinner spinner_;
};

}  // namespace grid_path_planner::nodes
