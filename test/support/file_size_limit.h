// A full disk, as a process meets it: no file may grow beyond a number of bytes (RLIMIT_FSIZE).
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/error_text.h"

namespace grid_path_planner::test {

// Runs `action` in a process of its own. True where it threw an InputError and lived on.
template <class Action>
bool refusedOnAFullDisk(rlim_t bytes, const Action& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::_exit(errorText(action).empty() ? 1 : 0);
  }
  int state = 0;
  ::waitpid(child, &state, 0);
  return WIFEXITED(state) && WEXITSTATUS(state) == 0;
}

}  // namespace grid_path_planner::test
