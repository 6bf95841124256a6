// A node's class inside a nodelet manager.
//
// A nodelet is a class that derives from NodeletShell<Node> and is exported by
// PLUGINLIB_EXPORT_CLASS.
//
// `Node` is constructed from a node handle and a private one, whose callbacks may throw
// (guarded_queue.h). As in a process of its own, none is called before the constructor has returned:
// the manager would call them in another thread. Why it is not loaded stands in the manager's log.
//
// One that commands a vehicle derives from CommanderShell<Node>: before a signal or `rosnode kill` ends the
// manager its `stop()` is called, from another thread (manager_shutdown.h).
#pragma once

#include <nodelet/nodelet.h>
#include <ros/console.h>
#include <ros/node_handle.h>

#include <exception>
#include <memory>
#include <optional>
#include <pluginlib/class_list_macros.hpp>

#include "ros/guard/ending/manager_shutdown.h"
#include "ros/guard/ending/nodelet_name_lock.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/master/master_watch.h"
#include "ros/guard/outgoing/topic_changes.h"

namespace grid_path_planner::nodes {

template <class Node>
class NodeletShell : public nodelet::Nodelet {
 public:
  ~NodeletShell() override {
    registered_.reset();
    const auto alone = lockTopics();
    node_.reset();
  }

 protected:
  Node& node() { return *node_; }

  void onInit() override {
    name_.emplace(getName());  // before the lock that the one before it leaves under
    nh_ = getNodeHandle();
    private_nh_ = getPrivateNodeHandle();
    queue_ = std::make_unique<GuardedQueue>(*nh_.getCallbackQueue());
    nh_.setCallbackQueue(queue_.get());
    private_nh_.setCallbackQueue(queue_.get());
    queue_->hold();
    const auto alone = lockTopics();
    try {
      node_ = std::make_unique<Node>(nh_, private_nh_);
    } catch (const std::exception& error) {  // of which the manager tells nobody
      ROS_FATAL_STREAM(getName() << " is not loaded: " << error.what());
      throw;
    }
    queue_->release();
    registered_ = MasterWatch::shared();
  }

 private:
  std::optional<NodeletNameLock> name_;  // first: it outlives the node
  ros::NodeHandle nh_, private_nh_;
  std::unique_ptr<GuardedQueue> queue_;

  std::unique_ptr<Node> node_;
  std::shared_ptr<MasterWatch> registered_;
};

// `finish` stops the vehicle in the thread that destroys the node.
template <class Node, void (Node::*finish)() = &Node::stop>
class CommanderShell : public NodeletShell<Node> {
 public:
  ~CommanderShell() override {
    const bool complete = end_.has_value();
    end_.reset();
    // At once, not when its turn comes: a nodelet that is loaded just now may read a world for half a minute.
    if (complete) (this->node().*finish)();
  }

 private:
  void onInit() override {
    NodeletShell<Node>::onInit();
    end_.emplace([this] { this->node().stop(); });
  }

  std::optional<ManagerShutdown> end_;
};

}  // namespace grid_path_planner::nodes
