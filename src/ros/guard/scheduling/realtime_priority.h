// A real-time priority for the calling thread, where the system grants one.
//
//   const std::string why = takeRealtimePriority(1);  // "" or "Operation not permitted"
//
// A thread that sleeps for most of the time and has to run on time, as one that commands a vehicle,
// waits otherwise for its turn among all threads of the machine, and on Linux for the turn of its
// session among all sessions.
#pragma once

#include <string>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::nodes {

// SCHED_FIFO (sched(7)) of `priority`, 1 to 99; 0: the ordinary scheduling. Returns why it is not
// granted, in the system's words, and then nothing has changed: it takes RLIMIT_RTPRIO of at least
// `priority`, or CAP_SYS_NICE.
std::string takeRealtimePriority(int priority);

// The option by which nodes that command take it.
template <class Visitor>
void visitRealtimePriority(int& priority, Visitor&& visit) {
  visit("realtime_priority", priority,
        base::OptionInfo{"Of the thread that commands (SCHED_FIFO), where the system grants it "
                         "(RLIMIT_RTPRIO): without, a busy machine silences the vehicle; 0: none",
                         "", 0, 99});
}

}  // namespace grid_path_planner::nodes
