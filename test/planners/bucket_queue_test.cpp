#include "planners/core/bucket_queue.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace grid_path_planner::planners {
namespace {

TEST(BucketQueue, PopsTheLowestBucketFirstAndItsLastEntry) {
  BucketQueue open;
  open.reset(100, 4);
  open.push(100, 1);
  open.push(150, 2);
  open.push(101, 3);
  open.push(1 << 20, 4);
  EXPECT_EQ(open.size(), 4u);
  EXPECT_EQ(open.pop(), 3u);
  EXPECT_EQ(open.pop(), 1u);
  EXPECT_EQ(open.lowest(), 144u);
  EXPECT_EQ(open.pop(), 2u);
  open.push(7, 5);  // below what was taken already
  EXPECT_EQ(open.pop(), 5u);
  EXPECT_EQ(open.pop(), 4u);
  EXPECT_TRUE(open.empty());
}

TEST(BucketQueue, IsEmptyAfterReset) {
  BucketQueue open;
  open.reset(0, 3);
  for (std::uint32_t i = 0; i < 5000; ++i) open.push(i * 97, i);
  open.reset(1000000, 3);
  EXPECT_TRUE(open.empty());
  open.push(1000001, 9);
  EXPECT_EQ(open.pop(), 9u);
  EXPECT_TRUE(open.empty());
}

// Keys never fall, as in a search: what is taken is at most two buckets away from the least key,
// whose buckets are only widened where they hold little.
TEST(BucketQueueLaw, LosesNothingAndItsLowestIsALowerBound) {
  std::mt19937_64 random(1);
  for (const SearchKey step : {SearchKey{50}, SearchKey{5000}, SearchKey{1} << 40}) {
    BucketQueue open;
    open.reset(12345, 3);
    std::map<std::uint32_t, SearchKey> held;
    std::uint32_t next = 0;
    const auto put = [&](SearchKey key) {
      open.push(key, next);
      held[next++] = key;
    };
    put(12345);
    for (int i = 0; i < 50000 && !open.empty(); ++i) {
      SearchKey least = kInfiniteKey;
      if (i % 100 == 0) {
        for (const auto& entry : held) least = std::min(least, entry.second);
        ASSERT_LE(open.lowest(), least);
      }
      const std::uint32_t index = open.pop();
      ASSERT_EQ(held.count(index), 1u) << "taken twice, or never put";
      const SearchKey key = held[index];
      held.erase(index);
      ASSERT_EQ(open.size(), held.size());
      for (std::size_t n = held.size() < 200 ? 1 + random() % 2 : random() % 2; n > 0; --n)
        put(key + random() % step);
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
