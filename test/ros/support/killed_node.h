// A node that a test kills, at the master.
//
// A master goes on to know what was killed, and calls its ports: with every change of a topic, and with `shutdown` when
// another node takes the name. A node of another test, with another master, may be there by then, which ends or
// hears nothing any more.
#pragma once

#include <ros/init.h>
#include <ros/master.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>

namespace grid_path_planner::test {

class KilledNode {
 public:
  // Before it is killed. `name` without a slash before it.
  explicit KilledNode(const std::string& name) : name_("/" + name), uri_(uriNow()) {}

  // The master forgets it, unless another has its name by now: who registers a name takes all that was registered by it.
  void forget() const {
    if (uri_.empty() || uriNow() != uri_) return;
    for (const char* method : {"registerSubscriber", "unregisterSubscriber"}) {
      XmlRpc::XmlRpcValue request, answer, value;
      request[0] = name_;
      request[1] = "/nobody";
      if (method == std::string("registerSubscriber")) request[2] = "std_msgs/Empty";
      request[request.size()] = "http://localhost:9/";  // discard: nobody is called there
      ros::master::execute(method, request, answer, value, false);
    }
  }

 private:
  std::string uriNow() const {
    XmlRpc::XmlRpcValue request, answer, value;
    request[0] = name_;
    request[1] = name_;
    if (!ros::isInitialized() || !ros::master::execute("lookupNode", request, answer, value, false))
      return "";
    return static_cast<std::string&>(value);
  }

  std::string name_, uri_;
};

}  // namespace grid_path_planner::test
