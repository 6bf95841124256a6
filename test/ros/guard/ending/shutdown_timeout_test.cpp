// A process that was asked to end while nobody answers at its master's address ended within 2 s as it was: what it was writing was
// lost. Here each process is a child of the test.
#include "ros/guard/master/shutdown_timeout.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>

namespace grid_path_planner::nodes {
namespace {

constexpr int kDone = 7;               // exit code of a process that came to its end
constexpr unsigned kMostSeconds = 60;  // s
constexpr std::chrono::seconds kLongWork(4);

// The exit code of a process that is asked to end and works on.
int endOf(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(kMostSeconds);
    ::setenv("ROS_MASTER_URI", "http://127.0.0.1:1", 1);
    const ShutdownTimeout limit("a node", [] { return true; });
    work();
    ::_exit(kDone);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ShutdownTimeout, EndsAProcessThatWaits) {
  EXPECT_EQ(endOf([] { std::this_thread::sleep_for(std::chrono::seconds(kMostSeconds)); }), 0);
}

TEST(ShutdownTimeout, LetsTheLastWorkBeDone) {
  EXPECT_EQ(endOf([] {
              const ShutdownBlocker work;
              std::this_thread::sleep_for(kLongWork);
            }),
            kDone);
}

TEST(ShutdownTimeout, EndsAProcessThatWaitsAfterIt) {
  EXPECT_EQ(endOf([] {
              { const ShutdownBlocker work; }
              std::this_thread::sleep_for(std::chrono::seconds(kMostSeconds));
            }),
            0);
}

}  // namespace
}  // namespace grid_path_planner::nodes
