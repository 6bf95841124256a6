#include "grid_path_planner/grid/cell.h"

#include <algorithm>

namespace grid_path_planner::grid {

CellRect CellRect::intersection(const CellRect& other) const {
  const int left = std::max(column, other.column);
  const int bottom = std::max(row, other.row);
  const int right = std::min(column + width, other.column + other.width);
  const int top = std::min(row + height, other.row + other.height);
  return {left, bottom, std::max(0, right - left), std::max(0, top - bottom)};
}

CellRect CellRect::hull(const CellRect& other) const {
  if (empty()) return other;
  if (other.empty()) return *this;
  const int left = std::min(column, other.column);
  const int bottom = std::min(row, other.row);
  const int right = std::max(column + width, other.column + other.width);
  const int top = std::max(row + height, other.row + other.height);
  return {left, bottom, right - left, top - bottom};
}

}  // namespace grid_path_planner::grid
