#include "costmap/weight_counts.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace grid_path_planner::costmap {

using grid::CellRect, grid::Grid;

namespace {

using Together = std::uint64_t;

Together from(const WeightCounts::Weight* weights) {
  Together together;
  std::memcpy(&together, weights, sizeof together);
  return together;
}

}  // namespace

void WeightCounts::makeRoomFor(Weight weight) {
  while (counts_.size() <= weight) counts_.resize(std::max<std::size_t>(64, 2 * counts_.size()));
  static_assert(sizeof(Together) == kTogether * sizeof(Weight));
}

void WeightCounts::add(const Grid<Weight>& weights) {
  const std::vector<Weight>& values = weights.values();
  add(values.data(), values.data() + values.size());
}

void WeightCounts::add(const Weight* first, const Weight* last) {
  while (first != last) {
    const Weight* const run = first;
    while (first != last && *first == *run) ++first;
    makeRoomFor(*run);
    counts_[*run][0] += static_cast<std::uint32_t>(first - run);
  }
}

void WeightCounts::replace(const Grid<Weight>& before, const Grid<Weight>& after,
                           const CellRect& rect) {
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    const Weight* old = before.row(row) + rect.column;
    const Weight* now = after.row(row) + rect.column;
    const Weight* const end = old + rect.width;
    for (; old + kTogether <= end; old += kTogether, now += kTogether)
      if (from(old) != from(now)) replace(old, now, kTogether);
    replace(old, now, static_cast<int>(end - old));
  }
}

inline void WeightCounts::replace(const Weight* before, const Weight* after, int number) {
  unsigned all = 0;
  for (int i = 0; i < number; ++i) all |= after[i];
  if (all >= counts_.size()) makeRoomFor(static_cast<Weight>(all));
  Parts* const counts = counts_.data();
  for (int i = 0; i < number; ++i) {
    --counts[before[i]][i];
    ++counts[after[i]][i];
  }
}

WeightCounts::Weight WeightCounts::minWeight() const {
  for (std::size_t weight = 1; weight < counts_.size(); ++weight)
    if (number(weight) != 0) return static_cast<Weight>(weight);
  return 0;
}

WeightCounts::Weight WeightCounts::maxWeight() const {
  for (std::size_t weight = counts_.size(); weight-- > 1;)
    if (number(weight) != 0) return static_cast<Weight>(weight);
  return 0;
}

}  // namespace grid_path_planner::costmap
