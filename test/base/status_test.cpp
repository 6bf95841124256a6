#include "grid_path_planner/base/status.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "grid_path_planner/base/statistics.h"

namespace grid_path_planner::base {
namespace {

// The names are a contract: messages and the command line carry them, in this order.
TEST(Status, NamesAndOrder) {
  const std::vector<std::string> names = {
      "FOUND",         "START_OUTSIDE_MAP", "GOAL_OUTSIDE_MAP", "START_OCCUPIED",
      "GOAL_OCCUPIED", "UNREACHABLE",       "TIMEOUT",          "CANCELLED",
      "NO_MAP",        "TRANSFORM_ERROR",   "INVALID_REQUEST"};
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(toString(static_cast<Status>(i)), names[i]);
}

TEST(Status, EachIsReadFromItsNameAndNothingElseIs) {
  for (int i = 0; i <= static_cast<int>(Status::INVALID_REQUEST); ++i)
    EXPECT_EQ(statusFromName(toString(static_cast<Status>(i))), static_cast<Status>(i));
  for (const char* name : {"", "found", "FOUND ", "ARRIVED", "0"})
    EXPECT_EQ(statusFromName(name), std::nullopt) << name;
}

TEST(Statistics, OfTwoSearchesCountersAddUpAndSizesDoNot) {
  Statistics a{10, 20, 1, 300, 0.5, 4000};
  a += Statistics{1, 2, 3, 400, 0.25, 50};
  EXPECT_EQ(a.expanded, 11u);
  EXPECT_EQ(a.generated, 22u);
  EXPECT_EQ(a.reopened, 4u);
  EXPECT_EQ(a.peak_open, 400u);
  EXPECT_EQ(a.time_s, 0.75);
  EXPECT_EQ(a.search_bytes, 4000u);
}

}  // namespace
}  // namespace grid_path_planner::base
