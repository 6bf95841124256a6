#include "ros/guard/nodelet_shell.h"
#include "ros/planning/path_planner_node.h"

namespace grid_path_planner::nodes {

class PathPlannerNodelet : public NodeletShell<PathPlannerNode> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::PathPlannerNodelet, nodelet::Nodelet)
