// ROS time of a clock that comes late.
#include "ros/guard/clock.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

constexpr double kAhead = 0.1;

// Its ROS time is that of /clock, which here comes from the tests.
class LateClockTest : public testing::Test {
 protected:
  LateClockTest() {
    ros::Time::init();
    ros::Time::setNow(ros::Time(100.0));
  }
  ~LateClockTest() override { ros::Time::init(); }

  LateClock clock_;
};

TEST_F(LateClockTest, WaitsForTheClockThatAMessageOvertook) {
  // Where the machine keeps the clock waiting for longer than it is waited for, another one tries.
  EXPECT_TRUE(test::waitFor([] {
    LateClock clock;
    ros::Time::setNow(ros::Time(100.0));
    std::thread late([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ros::Time::setNow(ros::Time(100.5));
    });
    const ros::Time found = clock.timeFor(ros::Time(100.5), kAhead);
    late.join();
    return found == ros::Time(100.5);
  }));
}

TEST_F(LateClockTest, DoesNotWaitForWhatMayBeAhead) {
  EXPECT_EQ(clock_.timeFor(ros::Time(100.05), kAhead), ros::Time(100.0));
  EXPECT_EQ(clock_.timeFor(ros::Time(), kAhead), ros::Time(100.0));
}

// The second would be the clock's if it were waited for.
TEST_F(LateClockTest, OneStampThatIsWrongDoesNotHoldTheOthers) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(clock_.timeFor(ros::Time(4294967295u, 0), kAhead), ros::Time(100.0));
  for (int i = 0; i < 100; ++i) clock_.timeFor(ros::Time(101.0), kAhead);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(spent.count(), 100 * 0.05);
}

// Beside the machine's own clock, which goes on meanwhile.
TEST(ClockWatch, TimeThatSeveralThreadsReadDoesNotGoBack) {
  ros::Time::init();
  ClockWatch clock;
  std::atomic<int> jumps = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int call = 0; call < 200000; ++call) jumps += clock.jumpedBack().has_value();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(jumps, 0);
}

TEST(ClockWatch, TimeThatWentBackIsToldOnce) {
  ros::Time::setNow(ros::Time(100.0));
  ClockWatch clock;
  EXPECT_FALSE(clock.jumpedBack());
  ros::Time::setNow(ros::Time(93.0));
  EXPECT_EQ(clock.jumpedBack(), 7.0);
  EXPECT_FALSE(clock.jumpedBack());
  ros::Time::init();
}

ros::Time raw(std::uint32_t seconds, std::uint32_t nanoseconds) {
  ros::Time time;
  time.sec = seconds;
  time.nsec = nanoseconds;
  return time;
}

TEST(NormalizedTime, IsTheSameTimeWhereThereIsOne) {
  EXPECT_EQ(normalized(raw(7, 999'999'999)), raw(7, 999'999'999));
  EXPECT_EQ(normalized(raw(7, 1'000'000'000)), raw(8, 0));
  EXPECT_EQ(normalized(raw(7, 4'294'967'295)), raw(11, 294'967'295));
  EXPECT_EQ(normalized(ros::TIME_MAX), ros::TIME_MAX);
}

TEST(NormalizedTime, IsTheLastWhereItIsBeyond) {
  EXPECT_EQ(normalized(raw(4'294'967'295, 1'000'000'000)), ros::TIME_MAX);
  EXPECT_EQ(normalized(raw(4'294'967'292, 4'294'967'295)), ros::TIME_MAX);
  EXPECT_EQ(normalized(raw(4'294'967'291, 4'294'967'295)), raw(4'294'967'295, 294'967'295));
}

}  // namespace
}  // namespace grid_path_planner::nodes
