// Which other nodes command the same vehicle, as the master's lists have it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ros/guard/master/system_state.h"

namespace grid_path_planner::nodes {

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

// The other nodes that publish one of the topics or offer one of the actions. `own` is the node's
// name with the master.
std::vector<OtherCommander> otherCommanders(const SystemState& state, const Commands& commands,
                                            const std::string& own);

// Those of them that registered the first topic that both have, by name, before `own` did; all where
// the master does not know `own`. Of two nodes that each ask this after all of theirs is registered,
// one at least is told of the other, however they took turns: the list of a topic has one order.
std::vector<OtherCommander> earlierCommanders(const SystemState& state, const Commands& commands,
                                              const std::string& own);

// The first that answers, `times` times a second at most: a node that was killed stays registered, and
// on a busy machine one may need more. None where there is none.
std::optional<OtherCommander> firstThatAnswers(const std::vector<OtherCommander>& others,
                                               int times);

// Throws InputError naming it.
[[noreturn]] void refuse(const OtherCommander& other);

}  // namespace grid_path_planner::nodes
