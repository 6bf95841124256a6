// What a node commands, for as long as the node lives: nobody else may.
//
// Other processes are known by the master, the other nodelets of this one only here: in a manager all
// have one name with the master, which cannot tell them apart.
#pragma once

#include <optional>
#include <string>

#include "ros/guard/master/commanders.h"

namespace grid_path_planner::nodes {

class CommandClaim {
 public:
  // Before the node advertises anything. Throws InputError naming another node that commands the same,
  // or the master that does not answer within some ten seconds.
  CommandClaim(const std::string& node, const Commands& commands);
  ~CommandClaim();
  CommandClaim(const CommandClaim&) = delete;
  CommandClaim& operator=(const CommandClaim&) = delete;

  // After it has advertised all that it commands: of nodes that start at once, those that the master
  // had later are refused. Throws InputError as above.
  void refuseSimultaneous() const;

  // A node of another process that commands the same by now; asks the master and waits a second for it.
  std::optional<OtherCommander> other() const;

 private:
  const std::string node_;
  const Commands commands_;
};

}  // namespace grid_path_planner::nodes
