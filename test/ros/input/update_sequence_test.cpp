#include "ros/input/update_sequence.h"

#include <gtest/gtest.h>

#include <string>

namespace grid_path_planner::nodes {
namespace {

TEST(UpdateSequence, CountsWhatIsMissingOfOnePublisher) {
  UpdateSequence sequence;
  EXPECT_EQ(sequence.note("/a", 7).missing, 0u) << "the first one";
  EXPECT_EQ(sequence.note("/a", 8).missing, 0u);
  EXPECT_EQ(sequence.note("/a", 11).missing, 2u);
  EXPECT_EQ(sequence.note("/a", 12).missing, 0u);
}

TEST(UpdateSequence, AnotherPublisherAndOneThatBeginsAgainHaveLostNothing) {
  UpdateSequence sequence;
  sequence.note("/a", 7);
  EXPECT_EQ(sequence.note("/b", 90).missing, 0u);
  EXPECT_EQ(sequence.note("/b", 0).missing, 0u);
  EXPECT_EQ(sequence.note("/b", 0).missing, 0u) << "one that does not count";
  EXPECT_EQ(sequence.note("/b", 4294967295u).missing, 4294967294u);
  EXPECT_EQ(sequence.note("/b", 0).missing, 0u);
}

// What was seen before, by reading: what another one sent between two of a publisher hid that one was missing between these.
TEST(UpdateSequence, AnotherPublisherBetweenThemHidesNothing) {
  UpdateSequence sequence;
  sequence.note("/a", 7);
  sequence.note("/b", 1);
  EXPECT_EQ(sequence.note("/a", 9).missing, 1u);
}

TEST(UpdateSequence, TellsWhoBeganAgain) {
  UpdateSequence sequence;
  EXPECT_FALSE(sequence.note("/a", 7).began_again);
  EXPECT_FALSE(sequence.note("/b", 1).began_again);
  EXPECT_FALSE(sequence.note("/a", 8).began_again);
  EXPECT_TRUE(sequence.note("/a", 1).began_again);
  EXPECT_FALSE(sequence.note("/a", 1).began_again) << "one that does not count";
}

TEST(UpdateSequence, StrangersAreForgotten) {
  UpdateSequence sequence;
  sequence.note("/a", 7);
  for (int i = 0; i < 8; ++i) sequence.note("/stranger_" + std::to_string(i), 1);
  EXPECT_EQ(sequence.note("/a", 9).missing, 0u);
}

}  // namespace
}  // namespace grid_path_planner::nodes
