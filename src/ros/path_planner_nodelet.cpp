#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "grid_path_planner/ros/path_planner_node.h"

namespace grid_path_planner {

// path_planner inside a nodelet manager.
class PathPlannerNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    node_ = std::make_unique<PathPlannerNode>(getNodeHandle(), getPrivateNodeHandle());
  }

  std::unique_ptr<PathPlannerNode> node_;
};

}  // namespace grid_path_planner

PLUGINLIB_EXPORT_CLASS(grid_path_planner::PathPlannerNodelet, nodelet::Nodelet)
