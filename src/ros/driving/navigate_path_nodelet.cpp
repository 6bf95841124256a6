#include "ros/driving/navigate_path_node.h"
#include "ros/guard/nodelet_shell.h"

namespace grid_path_planner::nodes {

class NavigatePathNodelet : public CommanderShell<NavigatePathNode> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::NavigatePathNodelet, nodelet::Nodelet)
