#include "grid_path_planner/base/read_limits.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "support/error_text.h"

namespace grid_path_planner::base {
namespace {

constexpr double kSeconds = 0.5;

ReadOptions shortTime() {
  ReadOptions options;
  options.read_time_limit = kSeconds;
  return options;
}

void outlast(ReadLimits& limits) {
  limits.start();
  std::this_thread::sleep_for(std::chrono::duration<double>(1.2 * kSeconds));
}

TEST(ReadLimits, TheTimeEndsByTheClock) {
  ReadLimits limits(shortTime());
  EXPECT_EQ(limits.processorSeconds(), kSeconds);
  outlast(limits);
  EXPECT_EQ(limits.processorSeconds(), 0.0);
  EXPECT_TRUE(
      test::contains(test::errorText([&] { limits.goOn("w.sdf"); }), "0.5 s that reading a file"));
}

TEST(ReadLimits, ProcessorTimeIsNotTakenByWaiting) {
  ReadLimits limits = ReadLimits::ofProcessorTime(shortTime());
  EXPECT_EQ(limits.processorSeconds(), kSeconds);
  outlast(limits);
  EXPECT_EQ(limits.processorSeconds(), kSeconds);
  EXPECT_EQ(test::errorText([&] { limits.goOn("w.sdf"); }), "");
}

// What a node has kept for itself is as good as before where there is no memory for it; of a stranger's file it is said
// that it cannot be read.
TEST(ReadLimits, WithoutLimitsWantOfMemoryIsNoFaultOfTheFile) {
  const auto read = [](ReadLimits& limits) {
    limits.take("kept.ot", std::size_t{1} << 60);
    throw std::bad_alloc();
  };
  EXPECT_THROW(readWithin("kept.ot", ReadLimits::none({}), read), std::bad_alloc);
  EXPECT_THROW(readWithin("kept.ot", ReadLimits(), [](ReadLimits&) { throw std::bad_alloc(); }),
               InputError);
}

TEST(ReadLimits, WithoutLimitsAStopEndsTheReading) {
  StopSource stop;
  const ReadLimits limits = ReadLimits::none(stop.token());
  limits.goOn("kept.ot");
  stop.cancel();
  EXPECT_THROW(limits.goOn("kept.ot"), InputError);
}

}  // namespace
}  // namespace grid_path_planner::base
