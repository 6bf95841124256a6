#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "grid_path_planner/ros/projected_map_node.h"

namespace grid_path_planner {

// projected_map inside a nodelet manager.
class ProjectedMapNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    node_ = std::make_unique<ProjectedMapNode>(getNodeHandle(), getPrivateNodeHandle());
  }

  std::unique_ptr<ProjectedMapNode> node_;
};

}  // namespace grid_path_planner

PLUGINLIB_EXPORT_CLASS(grid_path_planner::ProjectedMapNodelet, nodelet::Nodelet)
