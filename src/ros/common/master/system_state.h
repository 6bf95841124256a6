// Who publishes and offers what, as the master knows it.
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace grid_path_planner::nodes {

struct SystemState {
  using Nodes = std::map<std::string, std::vector<std::string>>;  // by topic or service
  Nodes publishers, subscribers, services;
};

// What the master answers to getSystemState; none where it is no such list of lists.
std::optional<SystemState> systemStateOf(XmlRpc::XmlRpcValue lists);

// None where the master does not answer within `seconds`.
std::optional<SystemState> systemState(double seconds);

// What a node commands, and nobody else may.
struct Commands {
  std::vector<std::string> topics;   // resolved names, of velocities
  std::vector<std::string> actions;  // resolved names
  // A topic: who publishes it (joysticks) and who subscribes to it (drivers) may publish the same
  // velocities, since drivers yield to joysticks.
  std::string manual_control;
  bool is_joystick = false;
};

struct OtherCommander {
  std::string node;
  std::string sentence;
};

// Another node that answers and publishes one of the topics, or offers one of the actions; none
// where there is none. A node that was killed stays registered, so each that is found is asked. It
// and the master have a second to answer, `times` at most: on a busy machine they may need more.
std::optional<OtherCommander> otherCommander(const Commands& commands, int times = 1);

// Throws InputError naming it.
[[noreturn]] void refuse(const OtherCommander& other);

}  // namespace grid_path_planner::nodes
