#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "ros/mapping/projected_map_node.h"

namespace grid_path_planner::nodes {

// projected_map inside a nodelet manager.
class ProjectedMapNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    node_ = std::make_unique<ProjectedMapNode>(getNodeHandle(), getPrivateNodeHandle());
  }

  std::unique_ptr<ProjectedMapNode> node_;
};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::ProjectedMapNodelet, nodelet::Nodelet)
