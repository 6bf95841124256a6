// The plugin grid_path_planner/GridPathPlanner of move_base: nav_core::BaseGlobalPlanner.
#include <nav_core/base_global_planner.h>

#include <pluginlib/class_list_macros.hpp>
#include <string>
#include <vector>

#include "ros/adapters/plugin_adapter.h"

namespace grid_path_planner::nodes {

class GlobalPlanner : public nav_core::BaseGlobalPlanner {
 public:
  void initialize(std::string name, costmap_2d::Costmap2DROS* costmap) override {
    adapter_.initialize(name, costmap);
  }

  bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                std::vector<geometry_msgs::PoseStamped>& plan) override {
    double cost = 0.0;
    return makePlan(start, goal, plan, cost);
  }

  bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                std::vector<geometry_msgs::PoseStamped>& plan, double& cost) override {
    PlannerAdapter::Answer answer = adapter_.makePlan(start, goal, std::nullopt);
    plan = std::move(answer.poses);
    cost = answer.cost;
    return answer.found();
  }

 private:
  PluginAdapter adapter_;
};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::GlobalPlanner, nav_core::BaseGlobalPlanner)
