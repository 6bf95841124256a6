#include "grid_path_planner/planners/precomputed_table.h"

#include <algorithm>

namespace grid_path_planner::planners {

using costmap::CostGrid;
using grid::CellRect;
using grid::GridGeometry;

CellRect cheaperCells(const CostGrid& before, const CostGrid& after, const CellRect& rect) {
  // Blocked is 0: one below it wraps to the largest value, dearer than any.
  const auto price = [](CostGrid::Weight weight) {
    return static_cast<CostGrid::Weight>(weight - 1);
  };
  CellRect cheaper;
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    const CostGrid::Weight* old = before.weights().row(row);
    const CostGrid::Weight* now = after.weights().row(row);
    const auto cheaperAt = [&](int column) { return price(now[column]) < price(old[column]); };
    int first = rect.column;
    int last = rect.column + rect.width - 1;
    while (first <= last && !cheaperAt(first)) ++first;
    if (first > last) continue;
    while (!cheaperAt(last)) --last;
    cheaper = cheaper.hull({first, row, last - first + 1, 1});
  }
  return cheaper;
}

bool looseAfter(const GridGeometry& geometry, std::size_t cells, const CellRect& hull) {
  const int side = std::max(geometry.width(), geometry.height());
  return cells > geometry.size() / 4 || std::max(hull.width, hull.height) > side / 8;
}

}  // namespace grid_path_planner::planners
