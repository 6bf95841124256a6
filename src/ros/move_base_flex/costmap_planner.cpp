// The plugin grid_path_planner/GridPathPlanner of Move Base Flex: mbf_costmap_core::CostmapPlanner.
#include <mbf_costmap_core/costmap_planner.h>

#include <pluginlib/class_list_macros.hpp>
#include <string>
#include <vector>

#include "ros/adapters/plugin_adapter.h"
#include "ros/move_base_flex/outcome.h"

namespace grid_path_planner::nodes {

class CostmapPlanner : public mbf_costmap_core::CostmapPlanner {
 public:
  void initialize(std::string name, costmap_2d::Costmap2DROS* costmap) override {
    adapter_.initialize(name, costmap);
  }

  std::uint32_t makePlan(const geometry_msgs::PoseStamped& start,
                         const geometry_msgs::PoseStamped& goal, double tolerance,
                         std::vector<geometry_msgs::PoseStamped>& plan, double& cost,
                         std::string& message) override {
    PlannerAdapter::Answer answer = adapter_.makePlan(start, goal, tolerance);
    plan = std::move(answer.poses);
    cost = answer.cost;
    message = std::move(answer.message);
    return outcomeOf(answer.status);
  }

  bool cancel() override { return adapter_.cancel(); }

 private:
  PluginAdapter adapter_;
};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::CostmapPlanner, mbf_costmap_core::CostmapPlanner)
