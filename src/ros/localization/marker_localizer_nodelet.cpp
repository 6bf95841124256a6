#include "ros/guard/nodelet_shell.h"
#include "ros/localization/marker_localizer_node.h"

namespace grid_path_planner::nodes {

class MarkerLocalizerNodelet : public NodeletShell<MarkerLocalizerNode> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::MarkerLocalizerNodelet, nodelet::Nodelet)
