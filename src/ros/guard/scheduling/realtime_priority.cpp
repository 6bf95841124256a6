#include "ros/guard/scheduling/realtime_priority.h"

#include <pthread.h>
#include <sched.h>

#include <system_error>

namespace grid_path_planner::nodes {

std::string takeRealtimePriority(int priority) {
  sched_param parameter = {};
  parameter.sched_priority = priority;
  const int policy = priority > 0 ? SCHED_FIFO : SCHED_OTHER;
  const int error = ::pthread_setschedparam(::pthread_self(), policy, &parameter);
  return error == 0 ? "" : std::generic_category().message(error);
}

}  // namespace grid_path_planner::nodes
