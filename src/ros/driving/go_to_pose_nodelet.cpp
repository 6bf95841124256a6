#include "ros/driving/go_to_pose_node.h"
#include "ros/guard/nodelet_shell.h"

namespace grid_path_planner::nodes {

class GoToPoseNodelet : public CommanderShell<GoToPoseNode, &GoToPoseNode::finish> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::GoToPoseNodelet, nodelet::Nodelet)
