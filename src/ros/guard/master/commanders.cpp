#include "ros/guard/master/commanders.h"

#include <algorithm>
#include <map>
#include <set>

#include "grid_path_planner/base/errors.h"
#include "ros/guard/master/xmlrpc_call.h"

namespace grid_path_planner::nodes {
namespace {

constexpr double kPatienceWithNode = 1.0;  // s

bool has(const SystemState::Nodes& nodes, const std::string& name, const std::string& node) {
  const auto found = nodes.find(name);
  return found != nodes.end() &&
         std::find(found->second.begin(), found->second.end(), node) != found->second.end();
}

// A topic by which a commander is known.
struct Mark {
  bool is_action;
  std::string verb_and_name;
};

// By name, so that two nodes look at those that both have in one order.
std::map<std::string, Mark> marksOf(const Commands& commands) {
  std::map<std::string, Mark> marks;
  for (const std::string& topic : commands.topics) marks[topic] = {false, "publishes " + topic};
  for (const std::string& action : commands.actions)
    marks[action + "/status"] = {true, "offers " + action};
  return marks;
}

// Each other commander by the first mark that both have: those registered before `own` and those after.
struct Others {
  std::vector<OtherCommander> earlier, later;
};

Others othersOf(const SystemState& state, const Commands& commands, const std::string& own) {
  const SystemState::Nodes& partners = commands.is_joystick ? state.subscribers : state.publishers;
  Others others;
  std::set<std::string> known{own};
  for (const auto& [topic, mark] : marksOf(commands)) {
    const auto publishers = state.publishers.find(topic);
    if (publishers == state.publishers.end()) continue;
    bool after_own = false;
    for (const std::string& node : publishers->second) {
      after_own = after_own || node == own;
      if (!mark.is_action && has(partners, commands.manual_control, node)) continue;
      if (!known.insert(node).second) continue;
      (after_own ? others.later : others.earlier)
          .push_back({node, "the node " + node + " " + mark.verb_and_name});
    }
  }
  return others;
}

bool answers(const std::string& node) {
  const auto uri = uriOfNode(node, kPatienceWithNode);
  return uri && answersXmlRpc(*uri, kPatienceWithNode);
}

}  // namespace

std::vector<OtherCommander> otherCommanders(const SystemState& state, const Commands& commands,
                                            const std::string& own) {
  Others others = othersOf(state, commands, own);
  others.earlier.insert(others.earlier.end(), others.later.begin(), others.later.end());
  return others.earlier;
}

std::vector<OtherCommander> earlierCommanders(const SystemState& state, const Commands& commands,
                                              const std::string& own) {
  return othersOf(state, commands, own).earlier;
}

std::optional<OtherCommander> firstThatAnswers(const std::vector<OtherCommander>& others,
                                               int times) {
  for (const OtherCommander& other : others)
    if (askPatiently(times, [&other] { return answers(other.node); })) return other;
  return std::nullopt;
}

void refuse(const OtherCommander& other) {
  throw base::InputError(other.sentence + ": two must not command one vehicle");
}

}  // namespace grid_path_planner::nodes
