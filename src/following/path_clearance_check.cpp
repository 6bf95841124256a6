#include "grid_path_planner/following/path_clearance_check.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::following {

using grid::Cell;
using grid::OccupancyGrid;

namespace {

using Eigen::Vector2d;

constexpr double kLongestPiece = 10.0;  // cells: keeps the boxes of slanting pieces small
constexpr double kGraze = 1e-9;         // cells

// Whether the segment meets the interior of the cell.
bool meets(const Vector2d& a, const Vector2d& b, Cell cell) {
  const Vector2d low(cell.column + kGraze, cell.row + kGraze);
  const Vector2d high(cell.column + 1 - kGraze, cell.row + 1 - kGraze);
  const Vector2d segment = b - a;
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    if (segment[axis] == 0.0) {
      if (a[axis] <= low[axis] || a[axis] >= high[axis]) return false;
      continue;
    }
    const double first = (low[axis] - a[axis]) / segment[axis];
    const double second = (high[axis] - a[axis]) / segment[axis];
    enter = std::max(enter, std::min(first, second));
    leave = std::min(leave, std::max(first, second));
  }
  return enter <= leave;
}

double distanceToCell(const Vector2d& point, Cell cell) {
  const double dx = std::max({cell.column - point.x(), point.x() - (cell.column + 1), 0.0});
  const double dy = std::max({cell.row - point.y(), point.y() - (cell.row + 1), 0.0});
  return std::hypot(dx, dy);
}

double distanceToSegment(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  const Vector2d segment = b - a;
  const double square = segment.squaredNorm();
  const double share = square > 0.0 ? std::clamp((point - a).dot(segment) / square, 0.0, 1.0) : 0.0;
  return (a + share * segment - point).norm();
}

bool tooNear(const Vector2d& a, const Vector2d& b, Cell cell, double radius) {
  if (meets(a, b, cell)) return true;
  if (radius <= 0.0) return false;
  double distance = std::min(distanceToCell(a, cell), distanceToCell(b, cell));
  for (const int right : {0, 1})
    for (const int up : {0, 1})
      distance =
          std::min(distance, distanceToSegment(Vector2d(cell.column + right, cell.row + up), a, b));
  return distance < radius - kGraze;
}

// In cells; of several the one nearest to `a`.
std::optional<Cell> firstOnPiece(const OccupancyGrid& map, int occupied_min, const Vector2d& a,
                                 const Vector2d& b, double radius) {
  const auto index = [](double x, int size) {
    return static_cast<int>(std::clamp(std::floor(x), -1.0, static_cast<double>(size)));
  };
  const Vector2d low = a.cwiseMin(b).array() - radius;
  const Vector2d high = a.cwiseMax(b).array() + radius;
  std::optional<Cell> first;
  for (int row = std::max(0, index(low.y(), map.height()));
       row <= std::min(map.height() - 1, index(high.y(), map.height())); ++row)
    for (int column = std::max(0, index(low.x(), map.width()));
         column <= std::min(map.width() - 1, index(high.x(), map.width())); ++column) {
      const Cell cell{column, row};
      if (map[cell] < occupied_min || !tooNear(a, b, cell, radius)) continue;
      if (!first || distanceToCell(a, cell) < distanceToCell(a, *first)) first = cell;
    }
  return first;
}

}  // namespace

std::optional<Cell> firstOccupied(const OccupancyGrid& map, int occupied_min,
                                  const std::vector<Eigen::Vector3d>& ahead, double radius) {
  const double radius_cells = radius / map.geometry().resolution();
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    const Vector2d a = map.geometry().gridFromWorld(ahead[i].head<2>());
    const Vector2d b =
        map.geometry().gridFromWorld(ahead[std::min(i + 1, ahead.size() - 1)].head<2>());
    const int pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kLongestPiece)));
    for (int piece = 0; piece < pieces; ++piece) {
      const Vector2d from = a + (b - a) * (static_cast<double>(piece) / pieces);
      const Vector2d to = a + (b - a) * (static_cast<double>(piece + 1) / pieces);
      if (const auto cell = firstOnPiece(map, occupied_min, from, to, radius_cells)) return cell;
    }
  }
  return std::nullopt;
}

}  // namespace grid_path_planner::following
