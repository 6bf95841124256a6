// The main program of a node: everything around the one class that is the node.
//
//   int main(int argc, char** argv) {
//     return grid_path_planner::nodes::runNode<grid_path_planner::nodes::SimulatorNode>(argc, argv, "simulator");
//   }
//
// Guaranteed: on every orderly end of the process (SIGINT, SIGTERM, rosnode kill, a second
// node of the same name, an exception), the node's destructor runs while its publishers still reach
// others, and the log says why. roscpp by itself closes all connections first, so that no last
// message leaves. An exception of a callback ends the callback (guarded_queue.h); a master that was
// restarted knows the node again (master_watch.h), and one that answers nobody does not keep it from
// ending (shutdown_timeout.h). A log that nobody reads holds up nobody, where it is a pipe (unread_log.h). Not
// guaranteed: anything after SIGKILL.
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ros/guard/node_arguments.h"
#include "ros/guard/node_files.h"

namespace grid_path_planner::nodes {

using NodeMaker =
    std::function<std::shared_ptr<void>(ros::NodeHandle& nh, ros::NodeHandle& private_nh)>;

// Whether a signal or the master has asked the node of this process to end: false in others.
bool nodeIsToEnd();

// Calls the global callback queue in this thread until the node ends. Returns the exit code:
// 0, or 1 after an exception of the node's construction that nobody asked for by ending it, or of
// `check`, which runs before the master hears of the node: a second one of its name that cannot run
// does not end the first.
int runNode(int argc, char** argv, const std::string& name, const NodeMaker& make,
            const std::function<void()>& check = {});

// `Node` is constructed from a node handle and a private one. Returns 2 for arguments that are not
// ROS's.
template <class Node>
int runNode(int argc, char** argv, const std::string& name) {
  if (const auto exit_code = nodeArguments(argc, argv, name).exit_code) return *exit_code;
  return runNode(argc, argv, name, [](ros::NodeHandle& nh, ros::NodeHandle& private_nh) {
    return std::make_shared<Node>(nh, private_nh);
  });
}

// The same for a node that reads or writes files: they are its third argument.
template <class Node>
int runNode(int argc, char** argv, const std::string& name,
            const std::vector<FileArgument>& files) {
  const NodeArguments given = nodeArguments(argc, argv, name, files);
  if (given.exit_code) return *given.exit_code;
  const NodeMaker make = [&given](ros::NodeHandle& nh, ros::NodeHandle& private_nh) {
    return std::make_shared<Node>(nh, private_nh,
                                  NodeFiles(given.files, given.save_folder, given.load_folder));
  };
  return runNode(argc, argv, name, make, [&] { checkGivenFiles(files, given.files); });
}

}  // namespace grid_path_planner::nodes
