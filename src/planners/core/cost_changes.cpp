#include "planners/core/cost_changes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace grid_path_planner::planners {

using costmap::CostGrid;
using grid::CellRect, grid::Grid;

namespace {

constexpr int kTogether = 8;
using Eight = std::uint16_t __attribute__((vector_size(16)));

bool any(const Eight& comparison) {
  using Halves = std::uint64_t __attribute__((vector_size(16)));
  const auto halves = reinterpret_cast<Halves>(comparison);
  return (halves[0] | halves[1]) != 0;
}

// The first `number` weights minus 1, so that blocked, which is 0, becomes the largest; zeros after
// them.
Eight minusOne(const CostGrid::Weight* weights, int number) {
  Eight eight = Eight{} + 1;
  if (number == kTogether)
    std::memcpy(&eight, weights, sizeof eight);
  else
    std::memcpy(&eight, weights, static_cast<std::size_t>(number) * sizeof *weights);
  return eight - 1;
}

// The smallest rectangle around cells that are added eight at a time, row after row.
class Hull {
 public:
  explicit Hull(const CellRect& rect)
      : rect_(rect), columns_(static_cast<std::size_t>(rect.width + kTogether - 1) / kTogether) {}

  void add(int row, std::size_t eight, const Eight& cells) {
    if (!any(cells)) return;
    columns_[eight] |= cells;
    if (first_row_ < 0) first_row_ = row;
    last_row_ = row;
  }

  CellRect rect() const {
    if (first_row_ < 0) return {};
    int first = 0, last = rect_.width - 1;
    while (!has(first)) ++first;
    while (!has(last)) --last;
    return {rect_.column + first, first_row_, last - first + 1, last_row_ - first_row_ + 1};
  }

 private:
  bool has(int column) const {
    return columns_[static_cast<std::size_t>(column) / kTogether][column % kTogether] != 0;
  }

  CellRect rect_;
  std::vector<Eight> columns_;  // where any row has cells
  int first_row_ = -1;
  int last_row_ = -1;
};

}  // namespace

CostChanges costChanges(const Grid<CostGrid::Weight>& before, const Grid<CostGrid::Weight>& after,
                        const CellRect& rect) {
  Hull increased(rect), decreased(rect);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    const CostGrid::Weight* old = before.row(row) + rect.column;
    const CostGrid::Weight* now = after.row(row) + rect.column;
    std::size_t eight = 0;
    for (int done = 0; done < rect.width; done += kTogether, ++eight) {
      const int number = std::min(kTogether, rect.width - done);
      const Eight was = minusOne(old + done, number), is = minusOne(now + done, number);
      increased.add(row, eight, reinterpret_cast<Eight>(is > was));
      decreased.add(row, eight, reinterpret_cast<Eight>(is < was));
    }
  }
  return {increased.rect(), decreased.rect()};
}

}  // namespace grid_path_planner::planners
