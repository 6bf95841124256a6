#include "ros/driving/teleop_joy_node.h"
#include "ros/guard/nodelet_shell.h"

namespace grid_path_planner::nodes {

class TeleopJoyNodelet : public CommanderShell<TeleopJoyNode> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::TeleopJoyNodelet, nodelet::Nodelet)
