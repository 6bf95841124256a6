#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "ros/simulation/simulator_node.h"

namespace grid_path_planner::nodes {

// The simulated vehicle inside a nodelet manager.
class SimulatorNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    node_ = std::make_unique<SimulatorNode>(getNodeHandle(), getPrivateNodeHandle());
  }

  std::unique_ptr<SimulatorNode> node_;
};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::SimulatorNodelet, nodelet::Nodelet)
