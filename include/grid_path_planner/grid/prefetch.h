// Prefetch of cells that are needed soon.
//
//   prefetchRows(map, changed);
//
// Rows of a large map lie in different pages of memory. Independent loads wait for their pages at
// the same time, where a computation would wait for one after the other. They are loads, since
// processors drop prefetch instructions whose page is not in the TLB. No value changes.
#pragma once

#include <cstddef>

#include "grid_path_planner/grid/grid.h"

namespace grid_path_planner::grid {

// A rectangle of `width` x `height` values in rows that lie `stride` values apart. Does nothing for
// a rectangle that is larger than the caches.
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
