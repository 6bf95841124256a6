// The node path_planner: map + start + goal -> path.
//
// Topics, services, parameters: doc/nodes.md. Planning runs in a thread of its own, so no callback
// waits for it; a new goal stops the planning for the one before, whose result is dropped. The path
// is planned again, from the vehicle's pose in tf, when a map blocks the remainder of it and every
// replan_period; it is kept while it is about as good as the new one (replan_policy.h).
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <ros/subscriber.h>

#include <memory>
#include <vector>

#include "ros/guard/master/command_claim.h"
#include "ros/guard/scheduling/ros_period.h"
#include "ros/planning/active_goal.h"
#include "ros/planning/plan_action.h"
#include "ros/planning/plan_diagnostics.h"
#include "ros/planning/plan_services.h"
#include "ros/planning/planning_server.h"
#include "ros/planning/rectangle_publisher.h"
#include "ros/planning/shown/cost_to_go_publisher.h"
#include "ros/planning/shown/planning_map_publisher.h"

namespace grid_path_planner {
class PathPlannerConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class PathPlannerNode {
 public:
  // Throws InputError for parameters that cannot be used, and for another node that offers the
  // action. Callbacks are called from the queue of
  // `nh`, those of the services from their own threads.
  PathPlannerNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const NodeFiles& files = {});
  // Stops all planning; requests that wait are answered CANCELLED.
  ~PathPlannerNode();

 private:
  // Callbacks
  void checkTime();
  void onGoal(const geometry_msgs::PoseStamped& message);
  void onInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message);
  void onOptions(const PathPlannerNodeOptions& options);
  void onMapChange();
  void replanInTime();

  // In the worker's thread
  void planForGoal(const base::StopSource& stop);
  void planFor(const GoalState& goal, const base::StopSource& stop);
  bool keepsOldPath(const GoalState& goal, const planning::Plan& plan,
                    const PlanningServer::Settings& settings, const base::StopSource& stop);
  void processMap(const base::StopSource& stop);
  void publishSearchedMap(const base::StopSource& stop);
  void publishRectangles(const PathPlannerNodeOptions& options,
                         const std::shared_ptr<const costmap::CostGrid>& costs);
  void publishCostToGo(const base::StopSource& stop);
  bool goalPathBlocked(const PathPlannerNodeOptions& options, const base::StopSource& stop);

  void postPlanForGoal();
  void postSearchedMap();
  void postCostToGo();

  ros::NodeHandle nh_;
  std::unique_ptr<CommandClaim> commands_;  // set in the constructor, after what may be refused
  ActiveGoal active_goal_;
  std::shared_ptr<const costmap::CostGrid> cut_costs_;  // into rectangles; the worker's
  std::unique_ptr<RectanglePublisher> rectangles_;      // the worker's; null until wanted
  std::unique_ptr<PlanningServer> server_;
  std::unique_ptr<PlanningMapPublisher> planning_map_;  // the worker's, once there is a map
  std::unique_ptr<CostToGoPublisher> cost_to_go_;
  std::unique_ptr<PlanServices> services_;
  std::unique_ptr<PlanAction> action_;
  std::unique_ptr<PlanDiagnostics> diagnostics_;
  std::unique_ptr<Reconfigurable<PathPlannerConfig, PathPlannerNodeOptions>> reconfigurable_;
  std::vector<ros::Subscriber> subscribers_;
  RosPeriod replan_period_;
  ros::SteadyTimer clock_timer_;
  ros::SteadyTimer full_map_timer_;
  std::shared_ptr<void> on_jump_back_;
};

}  // namespace grid_path_planner::nodes
