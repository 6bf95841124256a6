// The map that projected_map keeps for a restart was 23 s old, and not 5, on a machine with other work:
// its thread rests nine times as long as the writing has taken, and that was told by the clock.
#include "ros/guard/scheduling/cpu_share.h"

#include <gtest/gtest.h>

#include <thread>

namespace grid_path_planner::nodes {
namespace {

using Clock = std::chrono::steady_clock;

// So that what is taken is to rest for a thousand times as long.
constexpr double kShare = 0.001;

TEST(CpuShare, WaitingIsNoWork) {
  CpuShare share(kShare);
  EXPECT_TRUE(share.due());
  share.take([] { std::this_thread::sleep_for(std::chrono::milliseconds(300)); });
  const auto deadline = Clock::now() + std::chrono::seconds(60);  // of 300 s by the clock
  while (!share.due() && Clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(share.due());
}

TEST(CpuShare, WorkIsPaidFor) {
  CpuShare share(kShare);
  const std::clock_t begin = std::clock();
  share.take([&] {
    while (std::clock() - begin < CLOCKS_PER_SEC / 5) {
    }
  });
  EXPECT_FALSE(share.due()) << "for 200 s";
}

TEST(CpuShare, OfOneRestsNever) {
  CpuShare share(1.0);
  const std::clock_t begin = std::clock();
  share.take([&] {
    while (std::clock() - begin < CLOCKS_PER_SEC / 100) {
    }
  });
  EXPECT_TRUE(share.due());
}

}  // namespace
}  // namespace grid_path_planner::nodes
