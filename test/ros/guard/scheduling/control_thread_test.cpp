#include "ros/guard/scheduling/control_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <functional>
#include <stdexcept>
#include <thread>

namespace grid_path_planner::nodes {
namespace {

constexpr double kSeldom = 0.001;  // Hz

bool comesTrue(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return condition();
}

TEST(ControlThread, TicksWhateverATickThrows) {
  std::atomic<int> ticks{0};
  ControlThread thread([&] {
    ++ticks;
    throw std::runtime_error("a tick that fails");
  });
  thread.start(1000.0, 0);
  EXPECT_TRUE(comesTrue([&] { return ticks > 5; }));
}

// A command that a tick failed to replace would stay in force.
TEST(ControlThread, EachTickThatFailsSendsAZeroInItsPlace) {
  std::atomic<int> ticks{0}, zeros{0};
  ControlThread thread(
      [&] {
        if (++ticks % 2 == 0) throw std::runtime_error("a tick that fails");
      },
      [&] { ++zeros; });
  thread.start(1000.0, 0);
  ASSERT_TRUE(comesTrue([&] { return ticks >= 10; }));
  thread.stop();
  EXPECT_EQ(zeros, ticks / 2);
}

TEST(ControlThread, WorkIsNotKeptWaitingAndATickFollowsIt) {
  std::atomic<int> ticks{0};
  ControlThread thread([&] { ++ticks; });
  thread.start(kSeldom, 0);
  EXPECT_TRUE(comesTrue([&] { return ticks == 1; })) << "the first";
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(thread.ask([&] { return ticks.load(); }), 1);
  EXPECT_EQ(ticks, 2);
  thread.post([&] { thread.setRate(1000.0); });
  thread.post([&] { thread.restartPeriod(); });
  EXPECT_TRUE(comesTrue([&] { return ticks > 5; }));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(500)) << "of 1000 s";
}

TEST(ControlThread, WhatWorkThrowsComesBack) {
  ControlThread thread([] {});
  thread.start(kSeldom, 0);
  EXPECT_THROW(thread.ask([] { throw std::runtime_error("refused"); }), std::runtime_error);
  EXPECT_EQ(thread.ask([] { return 1; }), 1);
}

TEST(ControlThread, SaysHowItIsScheduled) {
  ControlThread thread([] {});
  thread.start(kSeldom, 0);
  EXPECT_TRUE(comesTrue([&] { return thread.scheduling() == "ordinary"; }));
  thread.ask([&] { thread.setPriority(1); });
  EXPECT_TRUE(thread.scheduling() == "real-time priority 1" ||
              thread.scheduling() == "ordinary: Operation not permitted")
      << thread.scheduling();
}

// Nothing else would come to run before a real-time thread, on a machine of one processor not even a stop.
TEST(ControlThread, LeavesHalfOfAProcessorToOthers) {
  std::atomic<int> ticks{0};
  ControlThread thread([&] {
    const std::clock_t begin = std::clock();
    while (std::clock() - begin < CLOCKS_PER_SEC / 50) {
    }
    ++ticks;
  });
  const auto begin = std::chrono::steady_clock::now();
  thread.start(1000.0, 0);
  ASSERT_TRUE(comesTrue([&] { return ticks >= 25; }));
  EXPECT_GT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(900))
      << "25 ticks of 20 ms take half a second";
}

}  // namespace
}  // namespace grid_path_planner::nodes
