#include "ros/guard/scheduling/log_throttle.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace grid_path_planner::nodes {
namespace {

TEST(LogThrottle, TellsOncePerPeriod) {
  LogThrottle seldom(1e6);
  EXPECT_TRUE(seldom.isDue());
  EXPECT_FALSE(seldom.isDue());
  LogThrottle always(0.0);
  EXPECT_TRUE(always.isDue());
  EXPECT_TRUE(always.isDue());
}

// The thread sanitizer saw the nodelets of a manager write the one time of the last line at once.
TEST(LogThrottle, IsDueForOneOfManyThreads) {
  LogThrottle seldom(1e6);
  std::atomic<int> due{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 1000; ++k) due += seldom.isDue() ? 1 : 0;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(due, 1);
}

}  // namespace
}  // namespace grid_path_planner::nodes
