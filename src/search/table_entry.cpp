#include "grid_path_planner/search/table_entry.h"

#include <algorithm>

namespace grid_path_planner {
namespace {

constexpr SearchKey kDiagonalKeyInverse = 1311738121U;  // modulo kStraightKey
static_assert(kDiagonalKey % kStraightKey * kDiagonalKeyInverse % kStraightKey == 1, "");

}  // namespace

TableUnit TableUnit::rounding(SearchKey longest) {
  TableUnit unit;
  unit.shift_ = 0;
  while ((longest >> unit.shift_) >= kNoEntry) ++unit.shift_;
  return unit;
}

TableEntry TableUnit::entryOf(SearchKey cost) const {
  if (cost == kInfiniteKey) return kNoEntry;
  if (exact()) return exactEntry(cost);
  return static_cast<TableEntry>(std::min<SearchKey>(cost >> shift_, kNoEntry - 1));
}

TableEntry TableUnit::exactEntry(SearchKey cost) {
  const SearchKey diagonal = cost % kStraightKey * kDiagonalKeyInverse % kStraightKey;
  if (diagonal > kMostDiagonal) return kNoEntry;
  const SearchKey straight = (cost - diagonal * kDiagonalKey) / kStraightKey;
  if (straight > kNoEntry / kStraight) return kNoEntry;
  const SearchKey entry = straight * kStraight + diagonal * kDiagonal;
  return entry < kNoEntry ? static_cast<TableEntry>(entry) : kNoEntry;
}

SearchKey TableUnit::roundedKey(TableEntry difference, const KeyScale& scale) const {
  if (difference <= 1) return 0;
  const SearchKey wide = static_cast<SearchKey>(difference - 1) << shift_;
  // Wide keys are the finer ones: what is less in them is less in any scale, but for the rounding.
  const double ratio = static_cast<double>(scale.straight) / static_cast<double>(kStraightKey);
  return static_cast<SearchKey>(static_cast<double>(wide) * ratio * (1.0 - 1e-15));
}

}  // namespace grid_path_planner
