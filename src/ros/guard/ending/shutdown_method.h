// roscpp's XML-RPC method `shutdown`, taken over: `rosnode kill` and the master, where a second node of the name comes, call it.
//
//   const ShutdownMethod method([](const std::function<void()>& pass_on) { pass_on(); });
//
// roscpp's own closes all connections of the process. `pass_on` does what it would have done; it may be called at any
// time and in any thread, also when this is gone. Guaranteed: after the destructor the method is roscpp's again, or whose
// it was, and none of its calls is in this library any more. Nothing is taken over before ROS was started; a call within
// the milliseconds of taking over and giving back finds no such method.
#pragma once

#include <ros/xmlrpc_manager.h>

#include <functional>

namespace grid_path_planner::nodes {

class ShutdownMethod {
 public:
  // Called in roscpp's XML-RPC thread, which waits for it.
  using Take = std::function<void(const std::function<void()>& pass_on)>;

  explicit ShutdownMethod(Take take);
  ~ShutdownMethod();
  ShutdownMethod(const ShutdownMethod&) = delete;
  ShutdownMethod& operator=(const ShutdownMethod&) = delete;

 private:
  struct Ours;

  void answer(XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& response) const;

  const Take take_;
  const ros::XMLRPCFunc before_;
};

}  // namespace grid_path_planner::nodes
