#include "ros/common/master/command_claim.h"

#include <ros/this_node.h>

#include <algorithm>
#include <list>
#include <mutex>
#include <vector>

namespace grid_path_planner::nodes {
namespace {

constexpr int kAskedAtStart = 10;  // times

struct Claim {
  const CommandClaim* owner;
  std::string node;
  Commands commands;
};

// Of this process.
struct Claims {
  std::mutex mutex;
  std::list<Claim> all;
};

Claims& claims() {
  static Claims claims;
  return claims;
}

std::string commonName(const std::vector<std::string>& some, const std::vector<std::string>& more) {
  const auto found = std::find_first_of(some.begin(), some.end(), more.begin(), more.end());
  return found == some.end() ? "" : *found;
}

// Drivers yield to joysticks.
bool yield(const Commands& a, const Commands& b) {
  return a.manual_control == b.manual_control && a.is_joystick != b.is_joystick;
}

std::string conflict(const Claim& other, const Commands& commands) {
  const std::string action = commonName(other.commands.actions, commands.actions);
  if (!action.empty()) return "the node " + other.node + " offers " + action;
  const std::string topic = commonName(other.commands.topics, commands.topics);
  if (topic.empty() || yield(other.commands, commands)) return "";
  return "the node " + other.node + " publishes " + topic;
}

}  // namespace

CommandClaim::CommandClaim(const std::string& node, const Commands& commands)
    : node_(node), commands_(commands) {
  if (const auto found = otherCommander(commands_, kAskedAtStart)) refuse(*found);
  const std::lock_guard<std::mutex> lock(claims().mutex);
  for (const Claim& other : claims().all) {
    const std::string sentence = conflict(other, commands_);
    if (!sentence.empty()) refuse({other.node, sentence});
  }
  claims().all.push_back({this, node_, commands_});
}

CommandClaim::~CommandClaim() {
  const std::lock_guard<std::mutex> lock(claims().mutex);
  claims().all.remove_if([this](const Claim& claim) { return claim.owner == this; });
}

void CommandClaim::refuseSimultaneous() const {
  const auto found = otherCommander(commands_, kAskedAtStart);
  if (found && found->node < ros::this_node::getName()) refuse(*found);
}

}  // namespace grid_path_planner::nodes
