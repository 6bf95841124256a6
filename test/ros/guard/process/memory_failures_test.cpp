// ros/guard/process/memory_failures.h: one failed allocation ends what asked for it, a second one soon after ends the process
// in order. A process of its own for each case, since the count is the process's.
#include "ros/guard/process/memory_failures.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>

#include "ros/guard/guarded_queue.h"

namespace grid_path_planner::nodes {
namespace {

constexpr int kEndedInOrder = 3, kWentOn = 4;

// As run_node.h and the commanders' shell do.
void handle(int signal) {
  std::signal(signal, [](int) { std::_Exit(kEndedInOrder); });
}

[[noreturn]] void failTwice() {
  handle(SIGINT);
  endAfterMemoryFailures();
  if (noteMemoryFailure()) std::_Exit(1);
  noteMemoryFailure();
  std::_Exit(kWentOn);
}

[[noreturn]] void callThatThrows(const std::function<void()>& callback, int times) {
  handle(SIGINT);
  endAfterMemoryFailures();
  ros::CallbackQueue behind;
  GuardedQueue queue(behind);
  for (int i = 0; i < times; ++i) {
    queue.addCallback(callbackOf(callback));
    callWaiting(behind, ros::WallDuration(0.0));
  }
  std::_Exit(kWentOn);
}

void failToAllocate() {
  throw std::bad_alloc();
}

TEST(MemoryFailures, ASecondOneEndsTheProcessInOrder) {
  EXPECT_EXIT(failTwice(), testing::ExitedWithCode(kEndedInOrder), "twice within 10 s");
}

// A nodelet's manager is another package's program, with nodelets of others.
TEST(MemoryFailures, AProcessThatIsNotTheNodesOwnGoesOn) {
  const auto fail = [] {
    if (noteMemoryFailure() || noteMemoryFailure()) std::_Exit(1);
    std::_Exit(kWentOn);
  };
  EXPECT_EXIT(fail(), testing::ExitedWithCode(kWentOn), "");
}

TEST(MemoryFailures, OneCallbackWithoutMemoryIsGivenUpAndTheNodeGoesOn) {
  EXPECT_EXIT(callThatThrows(failToAllocate, 1), testing::ExitedWithCode(kWentOn), "");
}

TEST(MemoryFailures, TwoCallbacksWithoutMemoryEndTheProcess) {
  EXPECT_EXIT(callThatThrows(failToAllocate, 2), testing::ExitedWithCode(kEndedInOrder),
              "twice within 10 s");
}

TEST(MemoryFailures, OtherExceptionsAreNone) {
  const auto refuse = [] { throw std::runtime_error("no map"); };
  EXPECT_EXIT(callThatThrows(refuse, 5), testing::ExitedWithCode(kWentOn), "");
}

}  // namespace
}  // namespace grid_path_planner::nodes
