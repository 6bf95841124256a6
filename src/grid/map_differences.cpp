#include "grid/map_differences.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace grid_path_planner::grid {

namespace {

constexpr int kSide = 64;  // of the squares of cells that each have a rectangle

bool same(const std::int8_t* a, const std::int8_t* b, int count) {
  return std::memcmp(a, b, static_cast<std::size_t>(count)) == 0;
}

// Extends the rectangles of a row of squares around the cells in which one of their rows differs.
void addRow(const std::int8_t* before, const std::int8_t* after, int width, int row,
            std::vector<CellRect>& rects) {
  for (int column = 0; column < width; column += kSide) {
    const int count = std::min(kSide, width - column);
    const std::int8_t* a = before + column;
    const std::int8_t* b = after + column;
    if (same(a, b, count)) continue;
    int first = 0, last = count - 1;
    while (a[first] == b[first]) ++first;
    while (a[last] == b[last]) --last;
    CellRect& rect = rects[static_cast<std::size_t>(column / kSide)];
    rect = rect.hull({column + first, row, last - first + 1, 1});
  }
}

}  // namespace

std::vector<CellRect> differences(const OccupancyGrid& before,
                                  const std::vector<std::int8_t>& after) {
  const int width = before.width();
  std::vector<CellRect> changed;
  std::vector<CellRect> rects(static_cast<std::size_t>((width + kSide - 1) / kSide));
  for (int row = 0; row < before.height(); ++row) {
    const std::int8_t* values = after.data() + static_cast<std::size_t>(row) * width;
    if (!same(before.row(row), values, width)) addRow(before.row(row), values, width, row, rects);
    if (row % kSide != kSide - 1 && row + 1 != before.height()) continue;
    changed.insert(changed.end(), rects.begin(), rects.end());
    std::fill(rects.begin(), rects.end(), CellRect());
  }
  return disjointRects(changed);
}

}  // namespace grid_path_planner::grid
