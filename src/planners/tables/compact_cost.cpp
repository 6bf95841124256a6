#include "planners/tables/compact_cost.h"

#include <algorithm>

namespace grid_path_planner::planners {

WideCost wideCostOf(SearchKey cost) {
  constexpr auto kMost = std::int64_t{1} << 53;
  constexpr auto kMostDiagonal = static_cast<std::int64_t>(kMediumScale.straight / 2);
  if (cost == kInfiniteKey) return kNoWideCost;
  const costmap::ExactCost exact = exactCostOf(cost, kWideScale);
  if (exact.diagonal > kMostDiagonal) return kNoWideCost;
  if (exact.straight > kMost / static_cast<std::int64_t>(kMediumScale.straight)) return kNoWideCost;
  const std::int64_t entry = exact.straight * static_cast<std::int64_t>(kMediumScale.straight) +
                             exact.diagonal * static_cast<std::int64_t>(kMediumScale.diagonal);
  return entry <= kMost ? static_cast<WideCost>(entry) : kNoWideCost;
}

SearchKey keyOfWide(WideCost difference, const KeyScale& scale) {
  if (difference >= kNoWideCost / 2) return kInfiniteKey;
  const auto key = static_cast<SearchKey>(difference);
  return scale.straight == kMediumScale.straight ? key : differenceKey(key, kMediumScale, scale);
}

CompactCostUnit CompactCostUnit::rounding(SearchKey longest) {
  CompactCostUnit unit;
  unit.shift_ = 0;
  while ((longest >> unit.shift_) >= kNoCompactCost) ++unit.shift_;
  return unit;
}

CompactCost CompactCostUnit::entryOf(SearchKey cost) const {
  if (cost == kInfiniteKey) return kNoCompactCost;
  if (exact()) return exactEntry(cost);
  return static_cast<CompactCost>(std::min<SearchKey>(cost >> shift_, kNoCompactCost - 1));
}

CompactCost CompactCostUnit::exactEntry(SearchKey cost) {
  const costmap::ExactCost exact = exactCostOf(cost, kWideScale);
  if (exact.diagonal > kMostDiagonal) return kNoCompactCost;
  if (exact.straight > kNoCompactCost / kStraight) return kNoCompactCost;
  const std::int64_t entry = exact.straight * kStraight + exact.diagonal * kDiagonal;
  return entry < kNoCompactCost ? static_cast<CompactCost>(entry) : kNoCompactCost;
}

SearchKey CompactCostUnit::roundedKey(CompactCost difference, const KeyScale& scale) const {
  if (difference <= 1) return 0;
  const SearchKey wide = static_cast<SearchKey>(difference - 1) << shift_;
  // Wide keys are the finer ones: what is less in them is less in any scale, but for the rounding.
  const double ratio = static_cast<double>(scale.straight) / static_cast<double>(kStraightKey);
  return static_cast<SearchKey>(static_cast<double>(wide) * ratio * (1.0 - 1e-15));
}

}  // namespace grid_path_planner::planners
