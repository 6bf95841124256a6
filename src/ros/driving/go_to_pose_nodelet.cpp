#include "ros/common/nodelet_shell.h"
#include "ros/driving/go_to_pose_node.h"

namespace grid_path_planner::nodes {

class GoToPoseNodelet : public CommanderShell<GoToPoseNode, &GoToPoseNode::finish> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::GoToPoseNodelet, nodelet::Nodelet)
