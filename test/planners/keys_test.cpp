#include "planners/core/keys.h"

#include <gtest/gtest.h>

#include <algorithm>
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

constexpr KeyScale kScales[] = {kWideScale,   kLabelScale, kMediumScale,
                                kPackedScale, kSmallScale, kWindowScale};

TEST(KeyScale, IsAConvergentOfRootTwo) {
  for (const KeyScale& scale : kScales) {
    const Wide error =
        Wide(scale.diagonal) * scale.diagonal - 2 * Wide(scale.straight) * scale.straight;
    EXPECT_TRUE(error == 1 || error == -1) << scale.diagonal << '/' << scale.straight;
    EXPECT_EQ(Wide(scale.diagonal) * inverseOfDiagonal(scale) % scale.straight, 1);
  }
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

TEST(KeyScaleLaw, KeysTellTheirExactCost) {
  std::mt19937_64 random(3);
  for (const KeyScale& scale : kScales) {
    const auto expectTold = [&scale](SearchKey straight, SearchKey diagonal) {
      const SearchKey key = straight * scale.straight + diagonal * scale.diagonal;
      ASSERT_LE(key, scale.largest);
      const ExactCost told = exactCostOf(key, scale);
      ASSERT_EQ(told.straight, static_cast<std::int64_t>(straight));
      ASSERT_EQ(told.diagonal, static_cast<std::int64_t>(diagonal));
    };
    const SearchKey most = std::min(scale.largest / scale.diagonal, scale.straight - 1);
    expectTold(0, 0);
    expectTold(0, most);
    expectTold(scale.largest / scale.straight, 0);
    for (int trial = 0; trial < 20000; ++trial) {
      const SearchKey diagonal = random() % (most + 1);
      const SearchKey rest = scale.largest - diagonal * scale.diagonal;
      expectTold(random() % (rest / scale.straight + 1), diagonal);
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
