// Waiting in rostests: for a condition, up to a deadline that only a failure reaches. It is there for what hangs, and says
// nothing of how fast anything is: a session may be left without any processor for ten seconds.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace grid_path_planner::test {

// Sanitizers make nodes some ten times slower.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kSlowdown = 4;
#else
constexpr int kSlowdown = 1;
#endif

constexpr std::chrono::seconds kDeadline(60 * kSlowdown);

// Whether `condition` came true before the deadline, asked every 5 ms of the steady clock, and once after it.
inline bool waitFor(const std::function<bool()>& condition,
                    std::chrono::duration<double> deadline = kDeadline) {
  const auto begin = std::chrono::steady_clock::now();
  while (true) {
    const bool is_last = std::chrono::steady_clock::now() - begin > deadline;
    if (condition()) return true;
    if (is_last) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace grid_path_planner::test
