#include "ros/adapters/outcome.h"

#include <gtest/gtest.h>

#include <map>

namespace grid_path_planner::nodes {

using base::Status;

namespace {

TEST(Outcome, IsThatOfMbfMsgsGetPath) {
  const std::map<Status, std::uint32_t> codes = {
      {Status::FOUND, 0},           {Status::CANCELLED, 51},        {Status::START_OUTSIDE_MAP, 52},
      {Status::START_OCCUPIED, 52}, {Status::GOAL_OUTSIDE_MAP, 53}, {Status::GOAL_OCCUPIED, 53},
      {Status::UNREACHABLE, 54},    {Status::TIMEOUT, 55},          {Status::TRANSFORM_ERROR, 57},
      {Status::NO_MAP, 58},         {Status::INVALID_REQUEST, 50}};
  for (const auto& [status, code] : codes) EXPECT_EQ(outcomeOf(status), code) << toString(status);
}

}  // namespace
}  // namespace grid_path_planner::nodes
