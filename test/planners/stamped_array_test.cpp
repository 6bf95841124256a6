#include "planners/core/stamped_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace grid_path_planner::planners {
namespace {

// The one test of the wrap-around: an entry that one query wrote stays empty in all later ones, also
// where the numbers of the queries begin again. Two turns of a stamp, each with an entry of its own.
TEST(StampedArray, AnEntryBelongsToOneQueryAlsoWhenTheNumbersBeginAgain) {
  constexpr std::size_t kQueries = 600;
  StampedArray<int, std::uint8_t> array(kQueries + 1);
  EXPECT_EQ(array.find(0), nullptr);
  for (std::size_t query = 0; query < kQueries; ++query) {
    array.clear();
    array.set(query, static_cast<int>(query));
    for (std::size_t index = 0; index <= kQueries; ++index)
      ASSERT_EQ(array.contains(index), index == query) << "query " << query << ", " << index;
    EXPECT_EQ(*array.find(query), static_cast<int>(query));
  }
}

TEST(StampedArray, KeepsItsEntriesWhenItGrows) {
  StampedArray<int> array(2);
  array.clear();
  array.set(1, 5);
  array.resize(4);
  ASSERT_NE(array.find(1), nullptr);
  EXPECT_EQ(array[1], 5);
  EXPECT_EQ(array.find(3), nullptr);
}

template <class Stamp>
class QueryStampTest : public testing::Test {};

using Stamps = testing::Types<QueryStamp<std::uint8_t, 1>, QueryStamp<std::uint8_t, 5>,
                              QueryStamp<std::uint16_t, 9>, QueryStamp<std::uint64_t, 56>>;
TYPED_TEST_SUITE(QueryStampTest, Stamps);

TYPED_TEST(QueryStampTest, AWordBelongsToOneQueryAlsoWhenTheNumbersBeginAgain) {
  using Word = decltype(std::declval<TypeParam>().word());
  constexpr std::size_t kQueries = 600;
  std::vector<Word> words(kQueries + 1, 0);
  TypeParam stamp;
  bool cleared = false;
  for (std::size_t query = 0; query < kQueries; ++query) {
    stamp.next([&] {
      std::fill(words.begin(), words.end(), Word{0});
      cleared = true;
    });
    words[query] = static_cast<Word>(stamp.word() | 1U);
    for (std::size_t index = 0; index <= kQueries; ++index)
      ASSERT_EQ(stamp.wrote(words[index]), index == query) << "query " << query << ", " << index;
  }
  EXPECT_TRUE(cleared);
}

TEST(QueryStamp, UsesNoMoreThanItsBits) {
  QueryStamp<std::uint16_t, 0, 3> stamp;
  std::uint16_t largest = 0;
  for (int query = 0; query < 20; ++query) {
    stamp.next([] {});
    EXPECT_NE(stamp.word(), 0);
    largest = std::max(largest, stamp.word());
  }
  EXPECT_EQ(largest, 7);
}

}  // namespace
}  // namespace grid_path_planner::planners
