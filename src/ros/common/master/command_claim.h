// What a node commands, for as long as the node lives: nobody else may.
//
// Other processes are known by the master, the other nodelets of this one only here: in a manager all
// have one name with the master, which cannot tell them apart.
#pragma once

#include <optional>
#include <string>

#include "ros/common/master/system_state.h"

namespace grid_path_planner::nodes {

class CommandClaim {
 public:
  // Before the node advertises anything. Throws InputError naming another node that commands the same.
  CommandClaim(const std::string& node, const Commands& commands);
  ~CommandClaim();
  CommandClaim(const CommandClaim&) = delete;
  CommandClaim& operator=(const CommandClaim&) = delete;

  // After it has advertised: of two nodes that start at once, that with the later name is refused.
  // Throws InputError.
  void refuseSimultaneous() const;

  // A node of another process that commands the same by now; asks the master and waits for it.
  std::optional<OtherCommander> other() const { return otherCommander(commands_); }

 private:
  const std::string node_;
  const Commands commands_;
};

}  // namespace grid_path_planner::nodes
