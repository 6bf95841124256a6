// Costs as one integer, the key, by which searches order them, and what is too large for one.
//
//   SearchKey key = 3 * kPackedScale.straight + 2 * kPackedScale.diagonal;  // 3 + 2 sqrt 2
//   ExactCost cost = exactCostOf(key, kPackedScale);                        // 3, 2
//
// The key of A + B sqrt 2 is A * straight + B * diagonal, where diagonal / straight is a convergent
// of sqrt 2. Guaranteed: keys up to `largest` of a scale are in the order of their costs, ties
// included, since B is below `straight` (costmap/exact_cost.h says why that is enough).
//
// All scales of the planners are here; a static_assert checks that each is a convergent.
#pragma once

#include <cstdint>
#include <limits>

#include "grid_path_planner/costmap/exact_cost.h"
#include "grid_path_planner/costmap/motion_model.h"

namespace grid_path_planner::planners {

using SearchKey = std::uint64_t;

constexpr SearchKey kInfiniteKey = std::numeric_limits<SearchKey>::max();

// Keys of a straight and a diagonal step of weight 1, and the largest key up to which the order is
// exact.
struct KeyScale {
  SearchKey straight;
  SearchKey diagonal;
  SearchKey largest;
};

constexpr SearchKey kStraightKey = 3166815962U;
constexpr SearchKey kDiagonalKey = 4478554083U;
// Costs up to 4.4e9 cell lengths x weight; more is refused.
constexpr SearchKey kLargestKey = kStraightKey * kDiagonalKey;
constexpr KeyScale kWideScale = {kStraightKey, kDiagonalKey, kLargestKey};
// 63 bits: costs up to 2.9e9.
constexpr KeyScale kLabelScale = {kStraightKey, kDiagonalKey, (SearchKey{1} << 63) - 1};
// 48 bits: costs up to 17.6e6.
constexpr KeyScale kMediumScale = {15994428, 22619537, (SearchKey{1} << 48) - 1};
// 43 bits: costs up to 3.2e6.
constexpr KeyScale kPackedScale = {2744210, 3880899, (SearchKey{1} << 43) - 1};
// 31 bits: costs up to 47,321.
constexpr KeyScale kSmallScale = {33461, 47321, SearchKey{33461} * 47321};
// For sums of eight steps of any weight, in doubles.
constexpr KeyScale kWindowScale = {1136689, 1607521, SearchKey{1136689} * 1607521};

// diagonal^2 - 2 straight^2, modulo 2^64: 1 for a convergent from above, -1 for one from below.
constexpr SearchKey convergentError(const KeyScale& scale) {
  return scale.diagonal * scale.diagonal - 2 * scale.straight * scale.straight;
}

constexpr bool isConvergent(const KeyScale& scale) {
  const SearchKey error = convergentError(scale);
  return (error == 1 || error == kInfiniteKey) && scale.largest / scale.diagonal <= scale.straight;
}

static_assert(isConvergent(kWideScale) && isConvergent(kLabelScale) && isConvergent(kMediumScale) &&
              isConvergent(kPackedScale) && isConvergent(kSmallScale) &&
              isConvergent(kWindowScale));

// Thrown where a path may cost more than keys can hold; Planner::search() answers INVALID_REQUEST.
struct TooExpensive {
  static constexpr const char* kMessage =
      "a path may cost more than 4.4e9 cell lengths x weight: use smaller weights";
};

constexpr SearchKey diagonalKey(costmap::DiagonalCost cost) {
  return cost == costmap::DiagonalCost::SQRT2 ? kDiagonalKey : kStraightKey;
}

constexpr SearchKey diagonalKey(const KeyScale& scale, costmap::DiagonalCost cost) {
  return cost == costmap::DiagonalCost::SQRT2 ? scale.diagonal : scale.straight;
}

// The inverse of `diagonal` modulo `straight`: diagonal^2 is 1 more, or less, than 2 straight^2.
constexpr SearchKey inverseOfDiagonal(const KeyScale& scale) {
  const SearchKey rest = scale.diagonal % scale.straight;
  return convergentError(scale) == 1 ? rest : scale.straight - rest;
}

// A and B of a key, in cells x weight. Precondition: it is at most scale.largest.
constexpr costmap::ExactCost exactCostOf(SearchKey key, const KeyScale& scale) {
  const SearchKey diagonal = key % scale.straight * inverseOfDiagonal(scale) % scale.straight;
  const SearchKey straight = (key - diagonal * scale.diagonal) / scale.straight;
  return {static_cast<std::int64_t>(straight), static_cast<std::int64_t>(diagonal)};
}

constexpr SearchKey saturatingSum(SearchKey a, SearchKey b) {
  return a > kInfiniteKey - b ? kInfiniteKey : a + b;
}

}  // namespace grid_path_planner::planners
