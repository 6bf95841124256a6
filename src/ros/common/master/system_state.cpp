#include "ros/common/master/system_state.h"

#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <algorithm>

#include "grid_path_planner/base/errors.h"
#include "ros/common/master/xmlrpc_call.h"
#include "ros/common/run_node.h"

namespace grid_path_planner::nodes {
namespace {

using XmlRpc::XmlRpcValue;

constexpr double kPatience = 1.0;  // that one is asked

// [[name, [node, node]], ...]
SystemState::Nodes nodesOf(XmlRpcValue& list) {
  SystemState::Nodes nodes;
  for (int i = 0; i < list.size(); ++i)
    for (int n = 0; n < list[i][1].size(); ++n)
      nodes[static_cast<std::string&>(list[i][0])].push_back(
          static_cast<std::string&>(list[i][1][n]));
  return nodes;
}

bool has(const SystemState::Nodes& nodes, const std::string& name, const std::string& node) {
  const auto found = nodes.find(name);
  return found != nodes.end() &&
         std::find(found->second.begin(), found->second.end(), node) != found->second.end();
}

// Again and again, `times` at most, until there is an answer or the node is to end.
template <class Ask>
auto askPatiently(int times, const Ask& ask) {
  auto answer = ask();
  for (int asked = 1; asked < times && !answer && !nodeIsToEnd(); ++asked) answer = ask();
  return answer;
}

bool answers(const std::string& node, int times) {
  return askPatiently(times, [&node] {
    const auto uri = uriOfNode(node, kPatience);
    return uri && answersXmlRpc(*uri, kPatience);
  });
}

// The first other node among the publishers of `topic` that `counts` takes and that answers.
template <class Counts>
std::string otherPublisher(const SystemState& state, const std::string& topic, int times,
                           Counts counts) {
  const auto publishers = state.publishers.find(topic);
  if (publishers == state.publishers.end()) return "";
  for (const std::string& node : publishers->second)
    if (node != ros::this_node::getName() && counts(node) && answers(node, times)) return node;
  return "";
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

std::optional<OtherCommander> otherCommander(const Commands& commands, int times) {
  const auto state = askPatiently(times, [] { return systemState(kPatience); });
  if (!state) return std::nullopt;
  const SystemState::Nodes& partners =
      commands.is_joystick ? state->subscribers : state->publishers;
  const auto conflicts = [&](const std::string& node) {
    return !has(partners, commands.manual_control, node);
  };
  for (const std::string& topic : commands.topics) {
    const std::string node = otherPublisher(*state, topic, times, conflicts);
    if (!node.empty()) return OtherCommander{node, "the node " + node + " publishes " + topic};
  }
  for (const std::string& action : commands.actions) {
    const std::string node =
        otherPublisher(*state, action + "/status", times, [](const std::string&) { return true; });
    if (!node.empty()) return OtherCommander{node, "the node " + node + " offers " + action};
  }
  return std::nullopt;
}

void refuse(const OtherCommander& other) {
  throw base::InputError(other.sentence + ": two must not command one vehicle");
}

}  // namespace grid_path_planner::nodes
