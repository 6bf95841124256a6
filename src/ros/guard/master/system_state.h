// Who publishes and offers what, as the master knows it.
#pragma once

#include <ros/subscriber.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ros/guard/run_node.h"

namespace grid_path_planner::nodes {

struct SystemState {
  // By topic or service, in the order in which they registered.
  using Nodes = std::map<std::string, std::vector<std::string>>;
  Nodes publishers, subscribers, services;
};

// What the master answers to getSystemState; none where it is no such list of lists.
std::optional<SystemState> systemStateOf(XmlRpc::XmlRpcValue lists);

// None where the master does not answer within `seconds`.
std::optional<SystemState> systemState(double seconds);

// Whether it offers a service whose name ends with /`name`; none where the master does not answer within `seconds`.
std::optional<bool> offersService(const std::string& node, const std::string& name, double seconds);

// Publishers answer within milliseconds; one that was killed never does, and the master knows it on.
constexpr double kLongestWaitForPublishers = 1.0;  // s

// Returns once `subscriber` is connected with as many publishers as the master knows of its topic, or after
// `seconds` of the steady clock, and says so: what they have latched follows at once. Says so, too, where the master does
// not answer, and returns.
void waitForPublishers(const ros::Subscriber& subscriber,
                       double seconds = kLongestWaitForPublishers);

// Again and again, `times` at most, until there is an answer or the node is to end.
template <class Ask>
auto askPatiently(int times, const Ask& ask) {
  auto answer = ask();
  for (int asked = 1; asked < times && !answer && !nodeIsToEnd(); ++asked) answer = ask();
  return answer;
}

}  // namespace grid_path_planner::nodes
