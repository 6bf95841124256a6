// Costs in 32 or 64 bits, for tables, which can be converted to keys of any scale.
//
// A cost A + B sqrt 2 is stored as its key of kSmallScale. While B is small, A and B can be computed
// from it, and from the difference of two: nothing is rounded, so paths of equal cost remain exactly
// equal, and a search with the table as its heuristic needs to expand only one of them. Larger costs
// are stored as multiples of a power of two of wide keys, rounded down: another CompactCostUnit; or exactly in
// 64 bits, as a double that holds a key of kMediumScale, which has 53 bits at most.
#pragma once

#include <cstdint>

#include "planners/core/keys.h"

namespace grid_path_planner::planners {

using CompactCost = std::int32_t;
constexpr CompactCost kNoCompactCost = 0x7fffffff;  // for unreachable cells

using WideCost = double;
constexpr WideCost kNoWideCost = 1e300;  // for unreachable cells

// The entry of a wide key: kNoWideCost for kInfiniteKey, and where it does not fit.
WideCost wideCostOf(SearchKey cost);
// |cost - cost| as a key of `scale` where two entries differ by this much, exactly; kInfiniteKey where one of them is
// kNoWideCost. Precondition: not negative.
SearchKey keyOfWide(WideCost difference, const KeyScale& scale);

// The key in scale `to` of A straight + B diagonal, whose key in `from` is this one. Precondition: |B| is at most half
// of from.straight.
constexpr SearchKey differenceKey(SearchKey difference, const KeyScale& from, const KeyScale& to) {
  const SearchKey modulo = difference % from.straight * inverseOfDiagonal(from) % from.straight;
  const auto signed_straight = static_cast<std::int64_t>(from.straight);
  const std::int64_t diagonal =
      static_cast<std::int64_t>(modulo) - (modulo > from.straight / 2 ? signed_straight : 0);
  const std::int64_t straight = (static_cast<std::int64_t>(difference) -
                                 diagonal * static_cast<std::int64_t>(from.diagonal)) /
                                signed_straight;
  return static_cast<SearchKey>(straight * static_cast<std::int64_t>(to.straight) +
                                diagonal * static_cast<std::int64_t>(to.diagonal));
}

class CompactCostUnit {
 public:
  // Exact.
  CompactCostUnit() = default;
  // The finest unit in which `longest` (a wide key) has an entry.
  static CompactCostUnit rounding(SearchKey longest);

  bool exact() const { return shift_ < 0; }

  // The entry of a wide key: kNoCompactCost for kInfiniteKey, and where the unit is exact and cannot hold
  // it. One that rounds gives the largest entry to what is beyond.
  CompactCost entryOf(SearchKey cost) const;

  // A key of `scale` that is certain where two entries differ by this much: |cost - cost|, or less
  // by up to two units. Precondition: not negative.
  SearchKey keyOf(CompactCost difference, const KeyScale& scale) const {
    return exact() ? exactKey(static_cast<std::uint32_t>(difference), scale)
                   : roundedKey(difference, scale);
  }

 private:
  static constexpr std::uint32_t kStraight = kSmallScale.straight;
  static constexpr std::uint32_t kDiagonal = kSmallScale.diagonal;
  static constexpr std::uint32_t kDiagonalInverse = inverseOfDiagonal(kSmallScale);
  static constexpr std::uint32_t kMostDiagonal = kStraight / 2;

  static CompactCost exactEntry(SearchKey cost);
  // The difference is some A * kStraight + B * kDiagonal with |B| at most kMostDiagonal.
  static SearchKey exactKey(std::uint32_t difference, const KeyScale& scale) {
    const std::uint32_t modulo = difference % kStraight * kDiagonalInverse % kStraight;
    const std::int64_t diagonal =
        std::int64_t{modulo} - (modulo > kMostDiagonal ? std::int64_t{kStraight} : 0);
    const std::int64_t straight = (difference - diagonal * kDiagonal) / std::int64_t{kStraight};
    return static_cast<SearchKey>(straight * static_cast<std::int64_t>(scale.straight) +
                                  diagonal * static_cast<std::int64_t>(scale.diagonal));
  }
  SearchKey roundedKey(CompactCost difference, const KeyScale& scale) const;

  int shift_ = -1;  // of a rounding unit
};

}  // namespace grid_path_planner::planners
