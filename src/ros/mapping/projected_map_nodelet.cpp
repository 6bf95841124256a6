#include "ros/guard/nodelet_shell.h"
#include "ros/mapping/projected_map_node.h"

namespace grid_path_planner::nodes {

class ProjectedMapNodelet : public NodeletShell<ProjectedMapNode> {};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::ProjectedMapNodelet, nodelet::Nodelet)
