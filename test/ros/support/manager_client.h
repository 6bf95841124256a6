// A client of a nodelet manager, which is not of this package.
#pragma once

#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>

#include <string>
#include <vector>

#include "ros/support/wait.h"

namespace grid_path_planner::test {

// Asks over one connection for each service, which is asked to last: of single calls some of 10,000 fail on a
// busy machine. roscpp's servers end a connection with the answer, and a client that has not begun to read by
// then drops it (our own nodes wait for their clients: lost_answer.test); or they take the news of an old
// connection's end for the end of a new one, before they have read the request.
class ManagerClient {
 public:
  explicit ManagerClient(const std::string& manager)
      : load_(client<nodelet::NodeletLoad>(manager + "/load_nodelet")),
        unload_(client<nodelet::NodeletUnload>(manager + "/unload_nodelet")),
        list_(client<nodelet::NodeletList>(manager + "/list")) {}

  bool load(nodelet::NodeletLoad& call) { return load_.call(call) && call.response.success; }
  bool unload(const std::string& nodelet) {
    nodelet::NodeletUnload call;
    call.request.name = nodelet;
    return unload_.call(call) && call.response.success;
  }
  std::vector<std::string> loaded() {
    nodelet::NodeletList call;
    if (!list_.call(call)) return {};
    return call.response.nodelets;
  }

 private:
  template <class Service>
  static ros::ServiceClient client(const std::string& service) {
    ros::service::waitForService(service, ros::Duration(kDeadline.count()));
    return ros::NodeHandle().serviceClient<Service>(service, true);
  }

  ros::ServiceClient load_, unload_, list_;
};

}  // namespace grid_path_planner::test
