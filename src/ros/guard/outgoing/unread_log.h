// The log of a program, where nobody reads it.
//
//   loseUnreadLog();     // before the first line
//
// Who writes to a pipe that is full waits until somebody reads: every thread that logs, for ever where the reader
// hangs. After this stdout and stderr, where they are pipes, take a megabyte, if the system grants that, and what is
// beyond is lost; `/rosout` has it all the same. Other programs that write to the same pipes wait as before. Not
// guaranteed: anything for terminals, sockets and what belongs to another user.
#pragma once

namespace grid_path_planner::nodes {

void loseUnreadLog();

}  // namespace grid_path_planner::nodes
