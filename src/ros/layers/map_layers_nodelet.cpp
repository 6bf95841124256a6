#include "ros/guard/nodelet_shell.h"
#include "ros/layers/map_layers_node.h"

namespace grid_path_planner::nodes {

class MapLayersNodelet : public NodeletShell<MapLayersNode> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::MapLayersNodelet, nodelet::Nodelet)
