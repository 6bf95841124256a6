#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "ros/planning/map_publisher_node.h"

namespace grid_path_planner::nodes {

// map_publisher inside a nodelet manager.
class MapPublisherNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    node_ = std::make_unique<MapPublisherNode>(getNodeHandle(), getPrivateNodeHandle());
  }

  std::unique_ptr<MapPublisherNode> node_;
};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::MapPublisherNodelet, nodelet::Nodelet)
