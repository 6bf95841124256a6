// Whoever commands the vehicle too since a node has started, in the node's diagnostics.
//
// A node that starts beside another of this package refuses to (command_claim.h). What comes later, or is no node of this
// package, can only be told.
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <mutex>
#include <string>

#include "grid_path_planner/base/task_queue.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/master/command_claim.h"

namespace grid_path_planner::nodes {

class OtherCommanders {
 public:
  // `commands` outlives this.
  explicit OtherCommanders(const CommandClaim& commands) : commands_(commands) {}

  // An error that names it, as far as the last question showed. Asks the master again, in a thread of its own.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  void ask();

  const CommandClaim& commands_;
  std::mutex mutex_;
  std::string sentence_;  // empty: nobody
  base::TaskQueue asker_{
      [](const std::string& error) { tellGivenUp("Asking who commands the vehicle", error); }};
};

}  // namespace grid_path_planner::nodes
