// Processor time of the calling thread, for the benchmarks.
#pragma once

#include <ctime>

namespace grid_path_planner::benchmark {

// Of `work`, in ms.
template <class Work>
double milliseconds(const Work& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  };
  const double begin = now();
  work();
  return now() - begin;
}

}  // namespace grid_path_planner::benchmark
