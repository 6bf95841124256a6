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

}  // namespace
}  // namespace grid_path_planner::nodes
