// The client of a service call: whether it still waits for the answer, and that the answer reaches it.
//
//   const ServiceCaller caller(service.getService(), event.getConnectionHeader());
//   while (!answered() && !caller.gone()) waitAWhile();
//
// roscpp notices at once that a client has closed its connection, or died, and says so to nobody: a
// call is computed to its end for no one. This asks the connection itself.
#pragma once

#include <ros/connection.h>
#include <ros/datatypes.h>

#include <boost/shared_ptr.hpp>
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

// The connection of the call with this header ends when the client closes it, which any client does once it
// has read the answer. By itself roscpp closes it right after writing. A client in roscpp that is told of
// the end before it has begun to read drops the answer, and its call fails: one in some ten thousand on
// a busy machine. Null is ignored.
void leaveEndToClient(const boost::shared_ptr<ros::M_string>& header);

}  // namespace grid_path_planner::nodes
