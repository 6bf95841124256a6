// Who waits for the answer to a service call, and whether they still do.
//
//   const ServiceCaller caller(service.getService(), event.getConnectionHeader());
//   while (!answered() && !caller.gone()) waitAWhile();
//
// roscpp notices at once that a client has closed its connection, or died, and says so to nobody: a
// call is computed to its end for no one. This asks the connection itself.
#pragma once

#include <ros/connection.h>
#include <ros/datatypes.h>

#include <string>

namespace grid_path_planner::nodes {

class ServiceCaller {
 public:
  // `service` is the resolved name; `header` that of the event, not a copy of it.
  ServiceCaller(const std::string& service, const ros::M_string& header);

  // Whether nobody would get an answer.
  bool gone() const { return !connection_ || connection_->isDropped(); }

 private:
  ros::ConnectionPtr connection_;  // null: it was closed before
};

}  // namespace grid_path_planner::nodes
