#include "ros/localization/kept_heading.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

TEST(KeptHeading, IsReadAsItWasWrittenAndNotInAnotherRun) {
  const std::string line = lineOf({1'700'000'000'123'456'789, -0.1, 3e-4}, "a-7");
  const auto heading = headingIn(line, "a-7");
  ASSERT_TRUE(heading);
  EXPECT_EQ(heading->stamp, 1'700'000'000'123'456'789);
  EXPECT_EQ(heading->offset, -0.1);
  EXPECT_EQ(heading->variance, 3e-4);
  EXPECT_FALSE(headingIn(line, "a-8"));
}

TEST(KeptHeading, NumbersThatCannotBeAreNone) {
  for (const char* line :
       {"", "run a", "run a stamp 1 offset nan variance 1", "run a stamp 1 offset 4 variance 1",
        "run a stamp 1 offset 0 variance -1", "run a stamp 1 offset 0 variance 1e9",
        "run a stamp x offset 0 variance 1", "run a stamp -1 offset 0 variance 1",
        "run a stamp 1 offset 0 deviation 1"})
    EXPECT_FALSE(headingIn(line, "a")) << line;
}

// A wall clock that was set back by a millisecond had it forgotten, and the pose began with the raw one of the IMU, OK.
TEST(KeptHeading, OutlivesAStepOfTheWallClockButNotABagThatBeginsAnew) {
  const localization::KnownHeading heading{100'000'000'000, -0.4, 3e-4};
  const auto after = headingAfterStep(heading, 60.0, 42'000'000'000, false);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->stamp, 40'000'000'000) << "2 s old, as before";
  EXPECT_EQ(after->offset, -0.4);
  EXPECT_EQ(after->variance, 3e-4);
  EXPECT_EQ(headingAfterStep(heading, 0.001, 99'000'000'000, false)->stamp, 99'000'000'000)
      << "never of the future";
  EXPECT_FALSE(headingAfterStep(heading, 60.0, 42'000'000'000, true));
  EXPECT_FALSE(headingAfterStep({}, 60.0, 42'000'000'000, false));
}

}  // namespace
}  // namespace grid_path_planner::nodes
