// Tells work that a node waits for, above all reading a file, that the node is to end.
//
//   const ShutdownFlag end;
//   readWorld(file, {read_options, end.token()});    // gives up on SIGTERM, rosnode kill, unload by shutdown
//
// A node's main thread and a nodelet's onInit look at no signal while they wait; a thread of this looks
// for them, for as long as it lives.
#pragma once

#include <atomic>
#include <thread>

#include "grid_path_planner/base/stop_token.h"

namespace grid_path_planner::nodes {

class ShutdownFlag {
 public:
  // `stop` is cancelled then; whoever has it may cancel it before.
  explicit ShutdownFlag(base::StopSource stop = {});
  ~ShutdownFlag();
  ShutdownFlag(const ShutdownFlag&) = delete;
  ShutdownFlag& operator=(const ShutdownFlag&) = delete;

  base::StopToken token() const { return stop_.token(); }

 private:
  base::StopSource stop_;
  std::atomic<bool> over_{false};
  std::thread watch_;
};

}  // namespace grid_path_planner::nodes
