#include "grid_path_planner/search/rising_keys.h"

namespace grid_path_planner {

void RisingKeys::begin(const GoalLabels& labels, const CostGrid& map, Cell start) {
  labels_ = &labels;
  start_ = start;
  raise_ = 0;
  const GridGeometry& geometry = map.geometry();
  const auto longest = static_cast<SearchKey>(geometry.width()) + geometry.height();
  const bool fits = longest * 2 * kPackedScale.straight <= kLargestEstimate / map.cheapest();
  scale_ = fits ? map.cheapest() : CostGrid::kBlocked;
  straight_ = kPackedScale.straight * scale_;
  diagonal_ = map.motion().connectivity == Connectivity::FOUR
                  ? 2 * straight_
                  : diagonalKey(kPackedScale, map.motion().diagonal_cost) * scale_;
}

void RisingKeys::move(Cell start) {
  raise_ += estimate(start_, start);
  start_ = start;
}

SearchKey RisingKeys::leastOf(const CellRect& rect, SearchKey least) const {
  const auto outside = [](int at, int first, int count) {
    return std::max({0, first - at, at - (first + count - 1)});
  };
  return raised(least + estimate(outside(start_.column, rect.column, rect.width),
                                 outside(start_.row, rect.row, rect.height)));
}

}  // namespace grid_path_planner
