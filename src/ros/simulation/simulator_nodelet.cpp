#include "ros/guard/nodelet_shell.h"
#include "ros/simulation/simulator_node.h"

namespace grid_path_planner::nodes {

class SimulatorNodelet : public NodeletShell<SimulatorNode> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::SimulatorNodelet, nodelet::Nodelet)
