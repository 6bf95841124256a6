#include "ros/guard/process/memory_failures.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <new>

namespace grid_path_planner::nodes {
namespace {

constexpr std::int64_t kNever = 0;

// Of the steady clock; kNever before the first.
std::atomic<std::int64_t> newest_failure{kNever};
std::atomic<bool> ends{false};

// Text that needs no memory.
void writeError(const char* text, std::size_t length) noexcept {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, length);
}

}  // namespace

void endAfterMemoryFailures() noexcept {
  ends = true;
}

bool noteMemoryFailure() noexcept {
  const std::int64_t now = std::chrono::steady_clock::now().time_since_epoch().count();
  const std::int64_t before = newest_failure.exchange(now);
  constexpr auto kBetween = std::chrono::steady_clock::duration(kBetweenMemoryFailures).count();
  if (!ends || before == kNever || now - before > kBetween) return false;
  constexpr char kText[] =
      "There was not enough memory twice within 10 s: the process ends, for respawn to start it "
      "anew\n";
  writeError(kText, sizeof kText - 1);
  ::kill(::getpid(), SIGINT);
  return true;
}

void noteCurrentError() noexcept {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    noteMemoryFailure();
  } catch (...) {
    return;
  }
}

}  // namespace grid_path_planner::nodes
