#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "ros/driving/teleop_joy_node.h"

namespace grid_path_planner::nodes {

// teleop_joy inside a nodelet manager.
class TeleopJoyNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    node_ = std::make_unique<TeleopJoyNode>(getNodeHandle(), getPrivateNodeHandle());
  }

  std::unique_ptr<TeleopJoyNode> node_;
};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::TeleopJoyNodelet, nodelet::Nodelet)
