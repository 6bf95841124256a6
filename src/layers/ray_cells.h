// The cells that a straight ray crosses, in order, the last one left out: that is where it ends (Amanatides & Woo,
// "A fast voxel traversal algorithm for ray tracing", Eurographics 1987).
//
//   visitRayCells(from, to, map.geometry().rect(), [&](Cell cell) { map[cell] = 0; });
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::layers {

// The part of a segment from `from` to `to` that lies in a rectangle, as shares; begin above end: none.
struct SegmentPart {
  double begin = 0.0;
  double end = 1.0;
};

inline SegmentPart partIn(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                          const grid::CellRect& within) {
  const Eigen::Vector2d low(within.column, within.row);
  const Eigen::Vector2d high(within.column + within.width, within.row + within.height);
  SegmentPart part;
  for (int axis = 0; axis < 2; ++axis) {
    const double along = to[axis] - from[axis];
    if (along == 0.0) {
      if (from[axis] < low[axis] || from[axis] >= high[axis]) return {1.0, 0.0};
      continue;
    }
    const double first = (low[axis] - from[axis]) / along;
    const double last = (high[axis] - from[axis]) / along;
    part.begin = std::max(part.begin, std::min(first, last));
    part.end = std::min(part.end, std::max(first, last));
  }
  return part;
}

// `from` and `to` in cells, finite; cells outside `within` are passed over. At a corner of the grid the ray goes by
// one of the two cells beside it.
template <class Visit>
void visitRayCells(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                   const grid::CellRect& within, Visit visit) {
  const SegmentPart part = partIn(from, to, within);
  if (part.begin > part.end) return;
  const Eigen::Vector2d along = to - from;
  const Eigen::Vector2d start = from + part.begin * along;
  const std::array<int, 2> low{within.column, within.row};
  const std::array<int, 2> size{within.width, within.height};
  std::array<int, 2> at{}, step{};
  std::array<double, 2> next{}, between{};  // shares of the whole segment
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    at[axis] =
        std::clamp(static_cast<int>(std::floor(start[i])), low[axis], low[axis] + size[axis] - 1);
    step[axis] = along[i] > 0.0 ? 1 : -1;
    const double border = along[i] > 0.0 ? at[axis] + 1.0 : at[axis];
    constexpr double kNever = std::numeric_limits<double>::infinity();
    next[axis] = along[i] == 0.0 ? kNever : (border - from[i]) / along[i];
    between[axis] = along[i] == 0.0 ? kNever : 1.0 / std::abs(along[i]);
  }
  const double last = std::min(1.0, part.end);
  for (;;) {
    const std::size_t axis = next[0] < next[1] ? 0 : 1;
    if (next[axis] >= 1.0) return;  // the ray ends in this cell
    visit(grid::Cell{at[0], at[1]});
    if (next[axis] >= last) return;  // it leaves the rectangle
    at[axis] += step[axis];
    if (at[axis] < low[axis] || at[axis] >= low[axis] + size[axis]) return;
    next[axis] += between[axis];
  }
}

}  // namespace grid_path_planner::layers
