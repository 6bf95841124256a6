// A node that a test kills, at the master, as killed_node.py has it.
#pragma once

#include <ros/init.h>
#include <ros/master.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>
#include <vector>

namespace grid_path_planner::test {

class KilledNode {
 public:
  // Before it is killed. The full name.
  explicit KilledNode(const std::string& name) : name_(name), uri_(uriNow()) {}

  // The master forgets it, unless another has its name by now: who registers a name takes all that was registered by it.
  void forget() const {
    if (uri_.empty() || uriNow() != uri_) return;
    const std::string discard = "http://localhost:9/";  // nobody is called there
    ask("registerSubscriber", {"/nobody", "std_msgs/Empty", discard});
    ask("unregisterSubscriber", {"/nobody", discard});
  }

 private:
  std::string uriNow() const {
    auto uri = ask("lookupNode", {name_});
    return uri.getType() == XmlRpc::XmlRpcValue::TypeString ? static_cast<std::string&>(uri) : "";
  }
  // Invalid without a success.
  XmlRpc::XmlRpcValue ask(const std::string& method,
                          const std::vector<std::string>& arguments) const {
    XmlRpc::XmlRpcValue request, answer, value;
    request[0] = name_;
    for (const std::string& argument : arguments) request[request.size()] = argument;
    const bool done =
        ros::isInitialized() && ros::master::execute(method, request, answer, value, false);
    return done ? value : XmlRpc::XmlRpcValue();
  }

  std::string name_, uri_;
};

}  // namespace grid_path_planner::test
