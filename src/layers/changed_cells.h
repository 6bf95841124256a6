// Cells that changed one by one, as rectangles that are worth their number: the smallest around those of each
// square of 32 cells.
//
//   changed.add({3, 5});
//   const std::vector<CellRect> rects = changed.take();      // disjointRects() of cell.h; then empty
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::layers {

class ChangedCells {
 public:
  // Precondition: column and row are not negative.
  void add(grid::Cell cell) {
    const auto square = static_cast<std::uint64_t>(cell.row / kSide) << 32U |
                        static_cast<std::uint32_t>(cell.column / kSide);
    grid::CellRect& rect = rects_[square];
    rect = rect.hull({cell.column, cell.row, 1, 1});
  }
  bool empty() const { return rects_.empty(); }
  void clear() { rects_.clear(); }

  std::vector<grid::CellRect> take() {
    std::vector<grid::CellRect> rects;
    rects.reserve(rects_.size());
    for (const auto& [square, rect] : rects_) rects.push_back(rect);
    rects_.clear();
    return grid::disjointRects(rects);
  }

 private:
  static constexpr int kSide = 32;  // cells

  std::unordered_map<std::uint64_t, grid::CellRect> rects_;
};

}  // namespace grid_path_planner::layers
