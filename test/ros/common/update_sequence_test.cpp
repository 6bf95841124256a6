#include "ros/common/update_sequence.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

TEST(UpdateSequence, CountsWhatIsMissingOfOnePublisher) {
  UpdateSequence sequence;
  EXPECT_EQ(sequence.missed("/a", 7), 0u) << "the first one";
  EXPECT_EQ(sequence.missed("/a", 8), 0u);
  EXPECT_EQ(sequence.missed("/a", 11), 2u);
  EXPECT_EQ(sequence.missed("/a", 12), 0u);
}

TEST(UpdateSequence, AnotherPublisherAndOneThatBeginsAgainHaveLostNothing) {
  UpdateSequence sequence;
  sequence.missed("/a", 7);
  EXPECT_EQ(sequence.missed("/b", 90), 0u);
  EXPECT_EQ(sequence.missed("/b", 0), 0u);
  EXPECT_EQ(sequence.missed("/b", 0), 0u) << "one that does not count";
  EXPECT_EQ(sequence.missed("/b", 4294967295u), 4294967294u);
  EXPECT_EQ(sequence.missed("/b", 0), 0u);
}

}  // namespace
}  // namespace grid_path_planner::nodes
