#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "ros/planning/path_planner_node.h"

namespace grid_path_planner::nodes {

// path_planner inside a nodelet manager.
class PathPlannerNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    node_ = std::make_unique<PathPlannerNode>(getNodeHandle(), getPrivateNodeHandle());
  }

  std::unique_ptr<PathPlannerNode> node_;
};

}  // namespace grid_path_planner::nodes

PLUGINLIB_EXPORT_CLASS(grid_path_planner::nodes::PathPlannerNodelet, nodelet::Nodelet)
