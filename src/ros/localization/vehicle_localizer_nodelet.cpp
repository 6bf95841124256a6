#include "ros/guard/nodelet_shell.h"
#include "ros/localization/vehicle_localizer_node.h"

namespace grid_path_planner::nodes {

class VehicleLocalizerNodelet : public NodeletShell<VehicleLocalizerNode> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::VehicleLocalizerNodelet, nodelet::Nodelet)
