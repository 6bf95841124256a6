#include "ros/guard/nodelet_shell.h"
#include "ros/planning/map_publisher_node.h"

namespace grid_path_planner::nodes {

class MapPublisherNodelet : public NodeletShell<MapPublisherNode> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::MapPublisherNodelet, nodelet::Nodelet)
