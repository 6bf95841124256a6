#include "grid_path_planner/terrain/weight_counts.h"

#include <cassert>

namespace grid_path_planner {
namespace {

// Calls visit(weight, length) for every run of equal weights along the rows.
template <class Visit>
void forEachRun(const Grid<WeightCounts::Weight>& weights, const CellRect& rect, Visit&& visit) {
  if (rect.empty()) return;
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    const WeightCounts::Weight* at = weights.row(row) + rect.column;
    const WeightCounts::Weight* const end = at + rect.width;
    while (at != end) {
      const WeightCounts::Weight* const first = at;
      while (at != end && *at == *first) ++at;
      visit(*first, static_cast<std::uint32_t>(at - first));
    }
  }
}

}  // namespace

void WeightCounts::add(const Grid<Weight>& weights, const CellRect& rect) {
  forEachRun(weights, rect, [this](Weight weight, std::uint32_t length) {
    if (weight >= counts_.size()) counts_.resize(std::size_t{weight} + 1);
    counts_[weight] += length;
  });
}

void WeightCounts::remove(const Grid<Weight>& weights, const CellRect& rect) {
  forEachRun(weights, rect, [this](Weight weight, std::uint32_t length) {
    assert(weight < counts_.size() && counts_[weight] >= length);
    counts_[weight] -= length;
  });
}

WeightCounts::Weight WeightCounts::cheapest() const {
  for (std::size_t weight = 1; weight < counts_.size(); ++weight)
    if (counts_[weight] != 0) return static_cast<Weight>(weight);
  return 0;
}

WeightCounts::Weight WeightCounts::dearest() const {
  for (std::size_t weight = counts_.size(); weight-- > 1;)
    if (counts_[weight] != 0) return static_cast<Weight>(weight);
  return 0;
}

}  // namespace grid_path_planner
