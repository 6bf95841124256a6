#include "ros/guard/master/system_state.h"

#include <ros/console.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "ros/guard/master/xmlrpc_call.h"

namespace grid_path_planner::nodes {
namespace {

using XmlRpc::XmlRpcValue;

// [[name, [node, node]], ...]
SystemState::Nodes nodesOf(XmlRpcValue& list) {
  SystemState::Nodes nodes;
  for (int i = 0; i < list.size(); ++i)
    for (int n = 0; n < list[i][1].size(); ++n)
      nodes[static_cast<std::string&>(list[i][0])].push_back(
          static_cast<std::string&>(list[i][1][n]));
  return nodes;
}

}  // namespace

std::optional<SystemState> systemStateOf(XmlRpcValue lists) {
  try {
    if (lists.getType() != XmlRpcValue::TypeArray || lists.size() != 3) return std::nullopt;
    return SystemState{nodesOf(lists[0]), nodesOf(lists[1]), nodesOf(lists[2])};
  } catch (const XmlRpc::XmlRpcException&) {
    return std::nullopt;
  }
}

std::optional<SystemState> systemState(double seconds) {
  const auto lists =
      callXmlRpc(masterUri(), "getSystemState", {XmlRpcValue(ros::this_node::getName())}, seconds);
  return lists ? systemStateOf(*lists) : std::nullopt;
}

std::optional<bool> offersService(const std::string& node, const std::string& name,
                                  double seconds) {
  const auto state = systemState(seconds);
  if (!state) return std::nullopt;
  const std::string end = "/" + name;
  const auto is_it = [&](const auto& service) {
    const auto& [full, nodes] = service;
    return full.size() >= end.size() &&
           full.compare(full.size() - end.size(), end.size(), end) == 0 &&
           std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  };
  return std::any_of(state->services.begin(), state->services.end(), is_it);
}

void waitForPublishers(const ros::Subscriber& subscriber, double seconds) {
  using SteadyClock = std::chrono::steady_clock;
  const auto end = SteadyClock::now() + std::chrono::duration<double>(seconds);
  const auto state = systemState(seconds);
  if (!state) {
    ROS_WARN("%s is not waited for: the master does not answer within %g s who publishes it",
             subscriber.getTopic().c_str(), seconds);
    return;
  }
  const auto known = state->publishers.find(subscriber.getTopic());
  if (known == state->publishers.end()) return;
  const std::size_t publishers = known->second.size();
  while (subscriber.getNumPublishers() < publishers && SteadyClock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  if (subscriber.getNumPublishers() < publishers)
    ROS_WARN("%s is not waited for any longer: %u of %zu publishers answer within %g s",
             subscriber.getTopic().c_str(), subscriber.getNumPublishers(), publishers, seconds);
}

}  // namespace grid_path_planner::nodes
