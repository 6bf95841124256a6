#include "ros/guard/run_node.h"

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <iostream>
#include <mutex>
#include <optional>

#include "ros/guard/guarded_queue.h"
#include "ros/guard/master/master_watch.h"
#include "ros/guard/master/shutdown_timeout.h"
#include "ros/guard/outgoing/topic_changes.h"
#include "ros/guard/outgoing/unread_log.h"
#include "ros/guard/process/freed_memory.h"
#include "ros/guard/process/memory_failures.h"

namespace grid_path_planner::nodes {
namespace {

std::atomic<bool> master_is_there{false};
std::atomic<bool> node_runs{false};
std::atomic<bool> node_process{false};
std::atomic<int> signal_received{0};

// A node that comes up ends as soon as it is up: roscpp breaks (SIGTRAP) when it is shut down under
// the makings of publishers and services. Where it waits for a master it may never be up; there,
// and at the second signal, it just ends: nothing has been driven yet.
void onSignal(int number) {
  const bool again = signal_received.exchange(number) != 0;
  if (!node_runs && (again || !master_is_there)) ::_exit(0);
}

// What the master asks for: a second node of this name came, or rosnode kill.
class ShutdownRequest {
 public:
  static ShutdownRequest& instance() {
    static ShutdownRequest request;
    return request;
  }

  // Replaces roscpp's own handler, which would close the connections.
  void listen() {
    const ros::XMLRPCManagerPtr& server = ros::XMLRPCManager::instance();
    server->unbind("shutdown");
    server->bind("shutdown", [this](XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& response) {
      receive(request);
      response = ros::xmlrpc::responseInt(1, "", 0);
    });
  }

  std::string reason() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return reason_;
  }

  bool came() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return !reason_.empty();
  }

 private:
  void receive(XmlRpc::XmlRpcValue& request) {
    const bool has_reason = request.getType() == XmlRpc::XmlRpcValue::TypeArray &&
                            request.size() > 1 &&
                            request[1].getType() == XmlRpc::XmlRpcValue::TypeString;
    const std::string told = has_reason ? static_cast<std::string>(request[1]) : "";
    const std::lock_guard<std::mutex> lock(mutex_);
    reason_ = told.empty() ? "asked by the master" : told;
  }

  std::mutex mutex_;
  std::string reason_;
};

// Empty while nothing asks the node to end.
std::string endReason() {
  if (signal_received) return "signal " + std::to_string(signal_received);
  return ShutdownRequest::instance().reason();
}

// Whether there is one. Takes no memory.
bool isAskedToEnd() {
  return signal_received != 0 || ShutdownRequest::instance().came();
}

void serve(const std::string& name, const NodeMaker& make) {
  static GuardedQueue queue(*ros::getGlobalCallbackQueue());  // waits in roscpp's longer than we do
  ros::NodeHandle nh;
  ros::NodeHandle private_nh("~");
  nh.setCallbackQueue(&queue);
  private_nh.setCallbackQueue(&queue);
  ShutdownRequest::instance().listen();
  std::shared_ptr<void> node = [&] {
    const auto alone = lockTopics();
    return make(nh, private_nh);
  }();
  auto registered = MasterWatch::shared();
  node_runs = true;
  // A process registers with the master at its first line of log. Were that the line that says why
  // it ends, the master would end the new node of this name in favour of the old one.
  ROS_INFO_STREAM(name << " runs");
  std::string reason = endReason();
  while (ros::ok() && reason.empty()) {
    callWaiting(*ros::getGlobalCallbackQueue(), ros::WallDuration(0.01));
    reason = endReason();
  }
  ROS_WARN_STREAM(name << " ends: " << (reason.empty() ? "ROS was shut down" : reason));
  registered->registerNoMore();  // others hold it until the node is gone
  const auto alone = lockTopics();
  node.reset();
}

// Where the check fails: the node does not come up.
std::optional<int> exitCodeOf(const std::function<void()>& check, const std::string& name) {
  try {
    if (check) check();
    return std::nullopt;
  } catch (const std::exception& error) {
    const std::string asked = endReason();
    std::cerr << name << (asked.empty() ? " does not start: " : " ends: ")
              << (asked.empty() ? error.what() : asked) << '\n';
    return asked.empty() ? 1 : 0;
  }
}

}  // namespace

bool nodeIsToEnd() {
  return node_process && isAskedToEnd();
}

int runNode(int argc, char** argv, const std::string& name, const NodeMaker& make,
            const std::function<void()>& check) {
  node_process = true;
  returnFreedMemory();
  endAfterMemoryFailures();
  loseUnreadLog();
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  const ShutdownTimeout limit(name, isAskedToEnd);
  int result = 0;
  master_is_there = ros::master::check();
  if (const auto exit_code = exitCodeOf(check, name)) return *exit_code;
  const ros::NodeHandle keeps_the_log_open;  // the last one to go shuts it, and the reason is lost
  master_is_there = true;
  try {
    serve(name, make);
  } catch (const std::exception& error) {
    const std::string asked = endReason();  // before it was up: what it waited for was given up
    ROS_FATAL_STREAM(name << " ends: " << (asked.empty() ? error.what() : asked));
    result = asked.empty() ? 1 : 0;
  }
  ros::shutdown();
  return result;
}

}  // namespace grid_path_planner::nodes
