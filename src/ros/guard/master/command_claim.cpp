#include "ros/guard/master/command_claim.h"

#include <ros/this_node.h>

#include <algorithm>
#include <list>
#include <mutex>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "ros/guard/master/xmlrpc_call.h"

namespace grid_path_planner::nodes {
namespace {

constexpr int kAskedAtStart = 10;            // times
constexpr double kPatienceWithMaster = 1.0;  // s, each time

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

// Of a node that starts. A master that says nothing is no leave to drive.
SystemState stateAtStart() {
  const auto state = askPatiently(kAskedAtStart, [] { return systemState(kPatienceWithMaster); });
  if (!state)
    throw base::InputError("the master at " + masterUri() +
                           " does not say whether another node commands the vehicle");
  return *state;
}

}  // namespace

CommandClaim::CommandClaim(const std::string& node, const Commands& commands)
    : node_(node), commands_(commands) {
  const auto others = otherCommanders(stateAtStart(), commands_, ros::this_node::getName());
  if (const auto found = firstThatAnswers(others, kAskedAtStart)) refuse(*found);
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
  const auto earlier = earlierCommanders(stateAtStart(), commands_, ros::this_node::getName());
  if (const auto found = firstThatAnswers(earlier, kAskedAtStart)) refuse(*found);
}

std::optional<OtherCommander> CommandClaim::other() const {
  const auto state = systemState(kPatienceWithMaster);
  if (!state) return std::nullopt;
  return firstThatAnswers(otherCommanders(*state, commands_, ros::this_node::getName()), 1);
}

}  // namespace grid_path_planner::nodes
