// Questions to a nodelet manager, which is not of this package.
#pragma once

#include <ros/ros.h>

#include <string>

namespace grid_path_planner::test {

// As ros::service::call(), over a connection that is asked to last: roscpp's servers end any other with the
// answer, and a client that has not begun to read by then drops the answer, as some of 10,000 calls on a busy
// machine (our own nodes wait for their clients, see lost_answer.test).
template <class Service>
bool callManager(const std::string& service, Service& call) {
  return ros::NodeHandle().serviceClient<Service>(service, true).call(call);
}

}  // namespace grid_path_planner::test
