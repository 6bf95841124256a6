// Cells that are needed soon, looked at together.
//
//   prefetchRows(map, changed);
//
// Rows of a large map lie in different pages of memory. One after the other each would be waited
// for; loads that depend on nothing are waited for together. Loads, as processors drop what is only
// prefetched where the page is not known either. Changes nothing but the time that comes after.
#pragma once

#include <cstddef>

#include "grid_path_planner/grid/grid.h"

namespace grid_path_planner::grid {

// A rectangle of `width` x `height` values, of rows that lie `stride` values apart. Nothing is done
// for one that caches would not hold.
template <class T>
void prefetchRows(const T* first, std::size_t stride, int width, int height) {
  constexpr std::size_t kCacheLine = 64, kMost = std::size_t{256} << 10;  // bytes
  constexpr int kStep = static_cast<int>(kCacheLine / sizeof(T));
  if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * sizeof(T) > kMost)
    return;
  const auto load = [](const T& value) {
    static_cast<void>(*static_cast<const volatile T*>(&value));
  };
  for (int row = 0; row < height; ++row, first += stride) {
    for (int i = 0; i < width; i += kStep) load(first[i]);
    if (width > 0) load(first[width - 1]);
  }
}

// Precondition: `rect` lies in the map.
template <class T>
void prefetchRows(const Grid<T>& map, const CellRect& rect) {
  if (rect.empty()) return;
  prefetchRows(map.row(rect.row) + rect.column, static_cast<std::size_t>(map.width()), rect.width,
               rect.height);
}

}  // namespace grid_path_planner::grid
