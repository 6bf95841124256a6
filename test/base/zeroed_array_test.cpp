#include "base/zeroed_array.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <new>
#include <utility>

namespace grid_path_planner::base {
namespace {

// Small ones, and those that ask for large pages.
TEST(ZeroedArray, HoldsZerosWhateverItsSize) {
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{100000},
        (std::size_t{64} << 20) / sizeof(std::uint32_t), (std::size_t{80} << 20) + 3}) {
    ZeroedArray<std::uint32_t> array(size);
    ASSERT_EQ(array.size(), size);
    for (std::size_t i = 0; i < size; i += 1 + size / 100) {
      ASSERT_EQ(array[i], 0u);
      array[i] = 7;
    }
    if (size > 0) array[size - 1] = 9;
    const ZeroedArray<std::uint32_t> moved = std::move(array);
    if (size > 0) {
      EXPECT_EQ(moved[size - 1], 9u);
    }
  }
}

TEST(ZeroedArray, IsReplacedByOneOfAnotherKind) {
  ZeroedArray<std::uint8_t> array(std::size_t{70} << 20);
  array[5] = 1;
  array = ZeroedArray<std::uint8_t>(10);
  EXPECT_EQ(array[5], 0);
  array[5] = 1;
  array = ZeroedArray<std::uint8_t>(std::size_t{70} << 20);
  EXPECT_EQ(array[5], 0);
}

TEST(ZeroedArray, SaysThatThereIsNotEnough) {
  const std::size_t largest = std::numeric_limits<std::size_t>::max();
  EXPECT_THROW(ZeroedArray<std::uint64_t>(largest / 2), std::bad_alloc);
  EXPECT_THROW(ZeroedArray<std::uint64_t>(largest / 16), std::bad_alloc);
}

}  // namespace
}  // namespace grid_path_planner::base
