#include "planners/rectangles/rectangle_union.h"

#include <utility>

#include "planners/rectangles/greedy_cut.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::BitMap, costmap::BitMaps;
using grid::CellRect;

namespace {

// Each column or row stands for those of the map from edges[i] to edges[i + 1].
struct UnevenLines {
  std::vector<int> edges;

  int between(int first, int end) const {
    return edges[std::size_t(end)] - edges[std::size_t(first)];
  }
  // The first of the last lines before `end` that stand for `length` of the map.
  int firstOf(int end, int length) const { return indexOf(edges[std::size_t(end)] - length); }
  int indexOf(int edge) const {
    return static_cast<int>(std::lower_bound(edges.begin(), edges.end(), edge) - edges.begin());
  }
};

// The edges along one axis, ascending.
UnevenLines linesOf(const std::vector<CellRect>& free, const std::vector<CellRect>& blocked,
                    int CellRect::*first, int CellRect::*size) {
  std::vector<int> edges;
  edges.reserve(2 * (free.size() + blocked.size()));
  for (const auto* rectangles : {&free, &blocked})
    for (const CellRect& rect : *rectangles) {
      edges.push_back(rect.*first);
      edges.push_back(rect.*first + rect.*size);
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return {std::move(edges)};
}

// The covered cells on the grid of the distinct edges.
struct Patch {
  UnevenLines columns;
  UnevenLines rows;
  BitMaps bits;

  Patch(const std::vector<CellRect>& free, const std::vector<CellRect>& blocked)
      : columns(linesOf(free, blocked, &CellRect::column, &CellRect::width)),
        rows(linesOf(free, blocked, &CellRect::row, &CellRect::height)) {
    const int width = static_cast<int>(columns.edges.size()) - 1;
    const int height = static_cast<int>(rows.edges.size()) - 1;
    bits.rows = BitMap(width, height);
    bits.columns = BitMap(height, width);
    for (const CellRect& rect : free) fillBits(bits, onLines(rect), true);
    for (const CellRect& rect : blocked) fillBits(bits, onLines(rect), false);
  }

  CellRect onLines(const CellRect& rect) const {
    const int column = columns.indexOf(rect.column), row = rows.indexOf(rect.row);
    return {column, row, columns.indexOf(rect.column + rect.width) - column,
            rows.indexOf(rect.row + rect.height) - row};
  }
  CellRect onMap(const CellRect& rect) const {
    return {columns.edges[std::size_t(rect.column)], rows.edges[std::size_t(rect.row)],
            columns.between(rect.column, rect.column + rect.width),
            rows.between(rect.row, rect.row + rect.height)};
  }
};

CellRect transposed(const CellRect& rect) {
  return {rect.row, rect.column, rect.height, rect.width};
}

}  // namespace

std::vector<CellRect> fewestRectangles(const std::vector<CellRect>& free,
                                       const std::vector<CellRect>& blocked,
                                       const StopToken& stop) {
  if (free.empty()) return {};
  Patch patch(free, blocked);
  std::vector<CellRect> fewest = mergedRuns(patch.bits.rows, stop);
  std::vector<CellRect> upright = mergedRuns(patch.bits.columns, stop);
  if (upright.size() < fewest.size()) {
    std::transform(upright.begin(), upright.end(), upright.begin(), transposed);
    fewest = std::move(upright);
  }
  // With one rectangle more the greedy cut is known to be worse.
  DecompositionLimits limits;
  limits.count = fewest.size() + 1;
  std::vector<CellRect> greedy =
      GreedyCut<UnevenLines>(std::move(patch.bits), patch.columns, patch.rows, limits, stop).run();
  if (greedy.size() <= fewest.size()) fewest = std::move(greedy);
  for (CellRect& rect : fewest) rect = patch.onMap(rect);
  return fewest;
}

}  // namespace grid_path_planner::planners
