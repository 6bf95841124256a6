#include "planners/core/radix_heap.h"

#include <gtest/gtest.h>

#include <queue>
#include <random>

namespace grid_path_planner::planners {
namespace {

// Keys that never fall below the last one popped, as those of a search with a consistent heuristic.
template <class Key>
void expectPopsInOrderOfKeys(std::mt19937& random, Key first, Key spread) {
  RadixHeap<Key> heap;
  heap.clear();
  std::vector<Key> keys;
  std::priority_queue<Key, std::vector<Key>, std::greater<Key>> reference;
  const auto push = [&](Key key) {
    heap.push(key, static_cast<std::uint32_t>(keys.size()));
    keys.push_back(key);
    reference.push(key);
  };
  push(first);
  std::size_t peak = 1;
  while (!reference.empty()) {
    ASSERT_FALSE(heap.empty());
    const Key key = keys[heap.pop()];
    ASSERT_EQ(key, reference.top());
    reference.pop();
    const std::size_t successors = keys.size() < 500 ? random() % 4 : 0;
    for (std::size_t i = 0; i < successors; ++i) push(key + static_cast<Key>(random()) % spread);
    peak = std::max(peak, reference.size());
  }
  EXPECT_TRUE(heap.empty());
  EXPECT_EQ(heap.peakSize(), peak);
}

TEST(RadixHeapLaw, PopsInOrderOfKeys) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const std::uint32_t spread = 1U << random() % 22;
    expectPopsInOrderOfKeys<std::uint32_t>(random, random() % 1000, spread);
    expectPopsInOrderOfKeys<std::uint64_t>(random, std::uint64_t{1} << random() % 62, spread);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

TEST(RadixHeap, HoldsKeysWithTheHighestBit) {
  RadixHeap<std::uint32_t> narrow;
  narrow.push(0xFFFFFFFFU, 1);
  narrow.push(0x80000000U, 2);
  narrow.push(7, 3);
  EXPECT_EQ(narrow.pop(), 3U);
  EXPECT_EQ(narrow.pop(), 2U);
  EXPECT_EQ(narrow.pop(), 1U);
  RadixHeap<std::uint64_t> wide;
  wide.push(std::uint64_t{1} << 62, 1);
  wide.push(0, 2);
  EXPECT_EQ(wide.pop(), 2U);
  EXPECT_EQ(wide.pop(), 1U);
}

TEST(RadixHeap, StartsAnewWhenCleared) {
  RadixHeap<std::uint32_t> heap;
  heap.push(100, 1);
  heap.push(200, 2);
  EXPECT_EQ(heap.pop(), 1U);
  heap.clear();
  EXPECT_TRUE(heap.empty());
  EXPECT_EQ(heap.peakSize(), 0U);
  heap.push(5, 3);
  heap.push(4, 4);
  EXPECT_EQ(heap.pop(), 4U);
  EXPECT_EQ(heap.pop(), 3U);
}

}  // namespace
}  // namespace grid_path_planner::planners
