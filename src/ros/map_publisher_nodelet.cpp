#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "grid_path_planner/ros/map_publisher_node.h"

namespace grid_path_planner {

// map_publisher inside a nodelet manager.
class MapPublisherNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    node_ = std::make_unique<MapPublisherNode>(getNodeHandle(), getPrivateNodeHandle());
  }

  std::unique_ptr<MapPublisherNode> node_;
};

}  // namespace grid_path_planner

PLUGINLIB_EXPORT_CLASS(grid_path_planner::MapPublisherNodelet, nodelet::Nodelet)
