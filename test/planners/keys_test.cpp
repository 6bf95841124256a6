#include "grid_path_planner/planners/keys.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <random>

#include "grid_path_planner/costmap/exact_cost.h"

namespace grid_path_planner::planners {

using costmap::ExactCost;

namespace {

using Wide = boost::multiprecision::cpp_int;

Wide keyOf(const ExactCost& cost) {
  return Wide(cost.straight) * kStraightKey + Wide(cost.diagonal) * kDiagonalKey;
}

TEST(SearchKey, IsAConvergentOfRootTwoFromAbove) {
  EXPECT_EQ(Wide(kDiagonalKey) * kDiagonalKey - 2 * Wide(kStraightKey) * kStraightKey, 1);
}

// As long as a path's diagonal part stays below kStraightKey, which kLargestKey guarantees.
TEST(SearchKeyLaw, OrdersAsTheExactCostsDo) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 200000; ++trial) {
    const auto drawn = [&random, trial] {
      const std::int64_t limit = trial % 2 == 0 ? 60 : 1500000000;
      return std::uniform_int_distribution<std::int64_t>(0, limit)(random);
    };
    const ExactCost a{drawn(), drawn()};
    ExactCost b{drawn(), drawn()};
    const bool nearly_tied = trial % 4 == 0 && a.diagonal >= 1311738121;
    if (nearly_tied) b = {a.straight + 1855077841, a.diagonal - 1311738121};
    ASSERT_EQ(a < b, keyOf(a) < keyOf(b))
        << a.straight << ' ' << a.diagonal << ' ' << b.straight << ' ' << b.diagonal;
    ASSERT_EQ(a == b, keyOf(a) == keyOf(b));
  }
}

TEST(SearchKeyLaw, PackedKeysTellTheirExactCost) {
  std::mt19937_64 random(3);
  const auto expectTold = [](SearchKey straight, SearchKey diagonal) {
    const SearchKey key = straight * kPackedScale.straight + diagonal * kPackedScale.diagonal;
    ASSERT_LE(key, kPackedScale.largest);
    const ExactCost told = exactCostOf(key);
    ASSERT_EQ(told.straight, static_cast<std::int64_t>(straight));
    ASSERT_EQ(told.diagonal, static_cast<std::int64_t>(diagonal));
  };
  const SearchKey most = kPackedScale.largest / kPackedScale.diagonal;
  expectTold(0, 0);
  expectTold(0, most);
  expectTold(kPackedScale.largest / kPackedScale.straight, 0);
  for (int trial = 0; trial < 100000; ++trial) {
    const SearchKey diagonal = random() % (most + 1);
    const SearchKey rest = kPackedScale.largest - diagonal * kPackedScale.diagonal;
    expectTold(random() % (rest / kPackedScale.straight + 1), diagonal);
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
