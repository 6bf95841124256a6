#include "ros/common/master/system_state.h"

#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcException.h>

#include "ros/common/master/xmlrpc_call.h"

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

}  // namespace grid_path_planner::nodes
