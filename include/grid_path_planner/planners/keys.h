// Costs as one integer, for ordering: A * kStraightKey + B * kDiagonalKey for A + B sqrt 2, where
// kDiagonalKey / kStraightKey is a convergent of sqrt 2. See costmap/exact_cost.h for why the order
// is exact as long as B < kStraightKey, which kLargestKey guarantees.
#pragma once

#include <cstdint>
#include <limits>

#include "grid_path_planner/costmap/exact_cost.h"
#include "grid_path_planner/costmap/motion_model.h"

namespace grid_path_planner::planners {

using SearchKey = std::uint64_t;

constexpr SearchKey kStraightKey = 3166815962U;
constexpr SearchKey kDiagonalKey = 4478554083U;
// A path of this cost is refused: 4.4e9 cell lengths x weight.
constexpr SearchKey kLargestKey = kStraightKey * kDiagonalKey;
constexpr SearchKey kInfiniteKey = std::numeric_limits<SearchKey>::max();

// A unit of length as keys: of a straight step of weight 1, of a diagonal one, and the largest key
// up to which the order is exact.
struct KeyScale {
  SearchKey straight;
  SearchKey diagonal;
  SearchKey largest;
};
constexpr KeyScale kWideScale = {kStraightKey, kDiagonalKey, kLargestKey};
// Keys of 43 bits, by an earlier convergent from above: costs up to 3.2e6 cell lengths x weight.
constexpr KeyScale kPackedScale = {2744210, 3880899, (SearchKey{1} << 43) - 1};

// Thrown by a search whose costs reach it; Planner::plan makes INVALID_REQUEST of it.
struct CostOverflow {};

constexpr SearchKey diagonalKey(costmap::DiagonalCost cost) {
  return cost == costmap::DiagonalCost::SQRT2 ? kDiagonalKey : kStraightKey;
}

constexpr SearchKey diagonalKey(const KeyScale& scale, costmap::DiagonalCost cost) {
  return cost == costmap::DiagonalCost::SQRT2 ? scale.diagonal : scale.straight;
}

// The number of which `of` times it leaves 1 modulo `modulus`. Precondition: they have no common
// divisor.
constexpr SearchKey inverseOf(SearchKey of, SearchKey modulus) {
  std::int64_t rest = static_cast<std::int64_t>(modulus), factor = 0;
  std::int64_t next_rest = static_cast<std::int64_t>(of % modulus), next_factor = 1;
  while (next_rest != 0) {
    const std::int64_t times = rest / next_rest;
    const std::int64_t last_rest = rest - times * next_rest;
    const std::int64_t last_factor = factor - times * next_factor;
    rest = next_rest;
    factor = next_factor;
    next_rest = last_rest;
    next_factor = last_factor;
  }
  return static_cast<SearchKey>(factor < 0 ? factor + static_cast<std::int64_t>(modulus) : factor);
}

// The A and B of a key of kPackedScale up to its largest, in cells x weight.
constexpr costmap::ExactCost exactCostOf(SearchKey packed_key) {
  constexpr SearchKey inverse = inverseOf(kPackedScale.diagonal, kPackedScale.straight);
  const SearchKey diagonal = packed_key % kPackedScale.straight * inverse % kPackedScale.straight;
  const SearchKey straight =
      (packed_key - diagonal * kPackedScale.diagonal) / kPackedScale.straight;
  return {static_cast<std::int64_t>(straight), static_cast<std::int64_t>(diagonal)};
}

constexpr SearchKey saturatingSum(SearchKey a, SearchKey b) {
  return a > kInfiniteKey - b ? kInfiniteKey : a + b;
}

}  // namespace grid_path_planner::planners
