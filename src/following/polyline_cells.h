// The cells of a map that a polyline meets, and where it does.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "grid_path_planner/grid/grid_geometry.h"

namespace grid_path_planner::following {

constexpr double kLongestPiece = 10.0;  // cells: keeps the boxes of slanting pieces small
constexpr double kGraze = 1e-9;         // cells

// The share of the segment (in cells) at which it comes into the cell without a margin of so many cells; none where
// it does not. With kGraze, grazing an edge or a corner meets nothing, with -kGraze it does.
inline std::optional<double> entryInto(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                       grid::Cell cell, double margin = kGraze) {
  const Eigen::Vector2d low(cell.column + margin, cell.row + margin);
  const Eigen::Vector2d high(cell.column + 1 - margin, cell.row + 1 - margin);
  const Eigen::Vector2d segment = b - a;
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    if (segment[axis] == 0.0) {
      if (a[axis] <= low[axis] || a[axis] >= high[axis]) return std::nullopt;
      continue;
    }
    const double first = (low[axis] - a[axis]) / segment[axis];
    const double second = (high[axis] - a[axis]) / segment[axis];
    enter = std::max(enter, std::min(first, second));
    leave = std::min(leave, std::max(first, second));
  }
  return enter <= leave ? std::optional<double>(enter) : std::nullopt;
}

// The cells of the map whose column and row lie between those of `low` and `high`.
inline grid::CellRect cellsBetween(const grid::GridGeometry& map, const Eigen::Vector2d& low,
                                   const Eigen::Vector2d& high) {
  const auto index = [](double x, int size) {
    return static_cast<int>(std::clamp(std::floor(x), -1.0, static_cast<double>(size)));
  };
  const int left = std::max(0, index(low.x(), map.width()));
  const int bottom = std::max(0, index(low.y(), map.height()));
  const int right = std::min(map.width() - 1, index(high.x(), map.width()));
  const int top = std::min(map.height() - 1, index(high.y(), map.height()));
  return {left, bottom, std::max(0, right - left + 1), std::max(0, top - bottom + 1)};
}

// Calls `visit(from, to)` (in cells) with pieces of the polyline `ahead` (map frame, metres; the z does not count)
// of at most ten cells, in order, until it returns true. A single point is a piece without length.
template <class Visit>
void visitPieces(const grid::GridGeometry& map, const std::vector<Eigen::Vector3d>& ahead,
                 Visit visit) {
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    const Eigen::Vector2d a = map.gridFromWorld(ahead[i].head<2>());
    const Eigen::Vector2d b = map.gridFromWorld(ahead[std::min(i + 1, ahead.size() - 1)].head<2>());
    const int pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kLongestPiece)));
    for (int piece = 0; piece < pieces; ++piece) {
      const Eigen::Vector2d from = a + (b - a) * (static_cast<double>(piece) / pieces);
      const Eigen::Vector2d to = a + (b - a) * (static_cast<double>(piece + 1) / pieces);
      if (visit(from, to)) return;
    }
  }
}

}  // namespace grid_path_planner::following
