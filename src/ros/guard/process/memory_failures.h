// What a process does when it has no memory: the first failure ends a request, a callback or a tick; a second one within
// 10 s ends the process in order, so that `respawn` starts it anew.
//
//   try { callback(); } catch (...) { noteCurrentError(); }
//
// Three places answer std::bad_alloc: the guarded queue (and with it timers and subscriptions), the task queue's OnError and
// the control thread. No other code repairs what a failed allocation left behind. A process that goes on after many
// failures has taken every repair by hand that we knew of, and readers went on finding one more.
//
// The process ends by its own SIGINT, which run_node.h and roscpp's nodelet manager answer by an orderly end. Thread-safe.
#pragma once

#include <chrono>
#include <string>

namespace grid_path_planner::nodes {

constexpr std::chrono::seconds kBetweenMemoryFailures(10);

// One failure. Returns whether the process was asked to end by it.
bool noteMemoryFailure() noexcept;

// The same where the exception that is being handled is std::bad_alloc; nothing otherwise. Precondition: called in a catch
// block.
void noteCurrentError() noexcept;

}  // namespace grid_path_planner::nodes
