// GridGeometry::cell() without a division, for inner loops.
#pragma once

#include <cstdint>

#include "grid_path_planner/grid/grid_geometry.h"

namespace grid_path_planner::planners {

class CellOfIndex {
 public:
  explicit CellOfIndex(const grid::GridGeometry& geometry)
      : width_(static_cast<std::uint32_t>(geometry.width())),
        shift_(static_cast<unsigned>(__builtin_clz(static_cast<unsigned>(geometry.height()))) + 31),
        inverse_((std::uint64_t{1} << shift_) / width_ + 1) {}

  // Exact: the inverse is at most 1 too large, which adds index / 2^shift to the quotient, less
  // than 1 / width for the fewer than 2^31 cells that a geometry has; and the product stays below
  // 2^64.
  grid::Cell operator()(std::uint32_t index) const {
    const auto row = static_cast<std::uint32_t>(index * inverse_ >> shift_);
    return {static_cast<int>(index - row * width_), static_cast<int>(row)};
  }

 private:
  std::uint32_t width_;
  unsigned shift_;
  std::uint64_t inverse_;
};

}  // namespace grid_path_planner::planners
