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

}  // namespace
}  // namespace grid_path_planner::base
