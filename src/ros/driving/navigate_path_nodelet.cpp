#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "ros/driving/navigate_path_node.h"

namespace grid_path_planner::nodes {

// The follower inside a nodelet manager.
class NavigatePathNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    node_ = std::make_unique<NavigatePathNode>(getNodeHandle(), getPrivateNodeHandle());
  }

  std::unique_ptr<NavigatePathNode> node_;
};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::NavigatePathNodelet, nodelet::Nodelet)
