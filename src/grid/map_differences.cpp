#include "grid/map_differences.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace grid_path_planner::grid {

namespace {

constexpr int kSide = 64;  // of the squares of cells that each have a rectangle

template <class Byte>
bool same(const Byte* a, const Byte* b, int count) {
  static_assert(sizeof(Byte) == 1);
  return std::memcmp(a, b, static_cast<std::size_t>(count)) == 0;
}

// Extends the rectangles of a row of squares around the cells in which one of their rows differs.
template <class Byte>
void addRow(const Byte* before, const Byte* after, int width, int row,
            std::vector<CellRect>& rects) {
  for (int column = 0; column < width; column += kSide) {
    const int count = std::min(kSide, width - column);
    const Byte* a = before + column;
    const Byte* b = after + column;
    if (same(a, b, count)) continue;
    int first = 0, last = count - 1;
    while (a[first] == b[first]) ++first;
    while (a[last] == b[last]) --last;
    CellRect& rect = rects[static_cast<std::size_t>(column / kSide)];
    rect = rect.hull({column + first, row, last - first + 1, 1});
  }
}

template <class Byte>
std::vector<CellRect> differingRects(const Grid<Byte>& before, const Byte* after) {
  const int width = before.width();
  std::vector<CellRect> changed;
  std::vector<CellRect> rects(static_cast<std::size_t>((width + kSide - 1) / kSide));
  for (int row = 0; row < before.height(); ++row) {
    const Byte* values = after + static_cast<std::size_t>(row) * width;
    if (!same(before.row(row), values, width)) addRow(before.row(row), values, width, row, rects);
    if (row % kSide != kSide - 1 && row + 1 != before.height()) continue;
    changed.insert(changed.end(), rects.begin(), rects.end());
    std::fill(rects.begin(), rects.end(), CellRect());
  }
  return disjointRects(changed);
}

}  // namespace

std::vector<CellRect> differences(const OccupancyGrid& before,
                                  const std::vector<std::int8_t>& after) {
  return differingRects(before, after.data());
}

std::vector<CellRect> differences(const Grid<std::uint8_t>& before, const std::uint8_t* after) {
  return differingRects(before, after);
}

}  // namespace grid_path_planner::grid
