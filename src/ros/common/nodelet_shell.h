// A node's class inside a nodelet manager.
//
// A nodelet is a class that derives from NodeletShell<Node> and is exported by
// PLUGINLIB_EXPORT_CLASS.
//
// `Node` is constructed from a node handle and a private one.
#pragma once

#include <nodelet/nodelet.h>

#include <memory>
#include <pluginlib/class_list_macros.hpp>

namespace grid_path_planner::nodes {

template <class Node>
class NodeletShell : public nodelet::Nodelet {
 private:
  void onInit() override {
    node_ = std::make_unique<Node>(getNodeHandle(), getPrivateNodeHandle());
  }

  std::unique_ptr<Node> node_;
};

}  // namespace grid_path_planner::nodes
