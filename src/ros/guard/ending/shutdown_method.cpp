#include "ros/guard/ending/shutdown_method.h"

#include <boost/thread/mutex.hpp>
#include <utility>

// What is bound to a method is private in roscpp, and its own `shutdown` has no other name. Naming private members in an
// explicit instantiation is the one thing that C++ allows.
namespace grid_path_planner::nodes {
namespace {

constexpr const char* kMethod = "shutdown";

template <class Functions>
ros::XMLRPCFunc functionIn(const Functions& functions, const std::string& name) {
  const auto found = functions.find(name);
  return found == functions.end() ? ros::XMLRPCFunc() : found->second.function;
}

ros::XMLRPCFunc boundTo(ros::XMLRPCManager& manager, const std::string& name);

template <auto functions, auto mutex, auto is_waited_for>
struct BoundMethods {
  // roscpp's thread, which holds the mutex nearly always, makes room for whoever says that it waits.
  friend ros::XMLRPCFunc boundTo(ros::XMLRPCManager& manager, const std::string& name) {
    manager.*is_waited_for = true;
    const boost::mutex::scoped_lock lock(manager.*mutex);
    manager.*is_waited_for = false;
    return functionIn(manager.*functions, name);
  }
};
template struct BoundMethods<&ros::XMLRPCManager::functions_, &ros::XMLRPCManager::functions_mutex_,
                             &ros::XMLRPCManager::unbind_requested_>;

// unbind() waits for a call that runs.
void rebind(ros::XMLRPCManager& manager, const ros::XMLRPCFunc& function) {
  manager.unbind(kMethod);
  manager.bind(kMethod, function);
}

// roscpp ignores what gives no reason. A value that cannot be read is one to it, an empty one.
bool isRequest(const XmlRpc::XmlRpcValue& request) {
  if (request.getType() != XmlRpc::XmlRpcValue::TypeArray || request.size() < 2) return false;
  return !request[1].valid() || request[1].getType() == XmlRpc::XmlRpcValue::TypeString;
}

}  // namespace

struct ShutdownMethod::Ours {
  const ShutdownMethod* method;

  void operator()(XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& response) const {
    method->answer(request, response);
  }
};

ShutdownMethod::ShutdownMethod(Take take)
    : take_(std::move(take)), before_(boundTo(*ros::XMLRPCManager::instance(), kMethod)) {
  if (!before_.empty()) rebind(*ros::XMLRPCManager::instance(), Ours{this});
}

// After ros::shutdown() nothing is bound; another may have taken it over meanwhile.
ShutdownMethod::~ShutdownMethod() {
  ros::XMLRPCManager& manager = *ros::XMLRPCManager::instance();
  const ros::XMLRPCFunc now = boundTo(manager, kMethod);
  const auto* ours = now.target<Ours>();
  if (ours && ours->method == this) rebind(manager, before_);
}

void ShutdownMethod::answer(XmlRpc::XmlRpcValue& request, XmlRpc::XmlRpcValue& response) const {
  if (!isRequest(request)) return before_(request, response);
  take_([before = before_, asked = request]() {
    XmlRpc::XmlRpcValue its_request = asked, its_response;
    before(its_request, its_response);
  });
  response = ros::xmlrpc::responseInt(1, "", 0);
}

}  // namespace grid_path_planner::nodes
