// Keeps what a thread does from time to time to a share of its time.
//
// With a share of a fifth, what was taken is followed by a rest four times as long. Counted is the
// processor's time of the thread: on a machine that has other work the same lasts longer, and is no more.
#pragma once

#include <ctime>

#include <chrono>

namespace grid_path_planner::nodes {

class CpuShare {
 public:
  // Precondition: 0 < share <= 1.
  explicit CpuShare(double share) : share_(share) {}

  // When what was taken last has been paid for, and whether it has.
  std::chrono::steady_clock::time_point notBefore() const { return not_before_; }
  bool due() const { return std::chrono::steady_clock::now() >= not_before_; }

  template <class Work>
  void take(Work work) {
    const double begin = threadSeconds();
    work();
    const std::chrono::duration<double> rest((threadSeconds() - begin) * (1.0 / share_ - 1.0));
    not_before_ = std::chrono::steady_clock::now() +
                  std::chrono::duration_cast<std::chrono::steady_clock::duration>(rest);
  }

 private:
  static double threadSeconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double share_;
  std::chrono::steady_clock::time_point not_before_;
};

}  // namespace grid_path_planner::nodes
