#include "ros/avoidance/local_planner_node.h"
#include "ros/guard/nodelet_shell.h"

namespace grid_path_planner::nodes {

class LocalPlannerNodelet : public CommanderShell<LocalPlannerNode> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::LocalPlannerNodelet, nodelet::Nodelet)
