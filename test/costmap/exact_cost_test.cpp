#include "grid_path_planner/costmap/exact_cost.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

namespace grid_path_planner::costmap {
namespace {

using Wide = boost::multiprecision::cpp_int;

// a + b sqrt 2 < c + d sqrt 2, from squares alone.
bool lessBySquares(const ExactCost& x, const ExactCost& y) {
  const Wide a = Wide(x.straight) - y.straight;  // a < b sqrt 2 ?
  const Wide b = Wide(y.diagonal) - x.diagonal;
  if (a < 0 && b >= 0) return true;
  if (a >= 0 && b <= 0) return false;
  if (a >= 0) return a * a < 2 * b * b;
  return a * a > 2 * b * b;
}

TEST(ExactCost, RoundsOnce) {
  EXPECT_EQ((ExactCost{7, 0}).toDouble(), 7.0);
  EXPECT_EQ((ExactCost{0, 1}).toDouble(), std::sqrt(2.0));
  EXPECT_EQ((ExactCost{3, 2}).toDouble(), 3.0 + 2.0 * std::sqrt(2.0));
}

TEST(ExactCost, TellsNeighboursOfRootTwoApart) {
  // 1855077841^2 = 2 * 1311738121^2 - 1: a double sees the same number twice.
  const ExactCost straight{1855077841, 0};
  const ExactCost diagonal{0, 1311738121};
  EXPECT_TRUE(straight < diagonal);
  EXPECT_FALSE(diagonal < straight);
}

TEST(ExactCostLaw, OrderIsThatOfTheNumbers) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 200000; ++trial) {
    const auto drawn = [&random, trial] {
      const std::int64_t limit = trial % 2 == 0 ? 60 : 1500000000;
      return std::uniform_int_distribution<std::int64_t>(0, limit)(random);
    };
    const ExactCost a{drawn(), drawn()};
    // Half of the pairs nearly tie: moved along the line of equal cost by a convergent of sqrt 2.
    ExactCost b{drawn(), drawn()};
    if (trial % 4 == 0) b = {a.straight + 1855077841, a.diagonal - 1311738121};
    if (b.diagonal < 0) b.diagonal = drawn();
    ASSERT_EQ(a < b, lessBySquares(a, b))
        << a.straight << ' ' << a.diagonal << ' ' << b.straight << ' ' << b.diagonal;
  }
}

}  // namespace
}  // namespace grid_path_planner::costmap
