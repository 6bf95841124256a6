// What a node does when it has no memory: the first failure ends a request, a callback or a tick; a second one within 10 s
// ends the node's process, so that `respawn` starts it anew.
//
//   endAfterMemoryFailures();   // run_node.h: the process is the node's own. Others, as a nodelet's manager, go on
//   noteCurrentError();         // in a catch block
//
// Three places answer std::bad_alloc: the guarded queue (and with it timers and subscriptions), the task queue's OnError and
// the control thread. The process ends by its own SIGINT, in order, unless memory fails while it ends, too. Thread-safe.
#pragma once

#include <chrono>
#include <string>

namespace grid_path_planner::nodes {

constexpr std::chrono::seconds kBetweenMemoryFailures(10);

// From now on a second failure ends the process.
void endAfterMemoryFailures() noexcept;

// One failure. Returns whether the process was asked to end by it.
bool noteMemoryFailure() noexcept;

// The same where the exception that is being handled is std::bad_alloc; nothing otherwise. Precondition: called in a catch
// block.
void noteCurrentError() noexcept;

}  // namespace grid_path_planner::nodes
