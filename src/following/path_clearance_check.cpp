#include "grid_path_planner/following/path_clearance_check.h"

#include <algorithm>
#include <cmath>

#include "following/polyline_cells.h"

namespace grid_path_planner::following {

using grid::Cell;
using grid::CellRect;
using grid::Occupancy;
using grid::OccupancyGrid;
using grid::OccupancyThresholds;

namespace {

using Eigen::Vector2d;

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
  if (entryInto(a, b, cell)) return true;
  if (radius <= 0.0) return false;
  double distance = std::min(distanceToCell(a, cell), distanceToCell(b, cell));
  for (const int right : {0, 1})
    for (const int up : {0, 1})
      distance =
          std::min(distance, distanceToSegment(Vector2d(cell.column + right, cell.row + up), a, b));
  return distance < radius - kGraze;
}

// Of those of these cells that `counts` takes the one nearest to `a`.
template <class Counts>
std::optional<Cell> nearestCell(const CellRect& cells, const Vector2d& a, Counts counts) {
  std::optional<Cell> first;
  for (int row = cells.row; row < cells.row + cells.height; ++row)
    for (int column = cells.column; column < cells.column + cells.width; ++column) {
      const Cell cell{column, row};
      if (!counts(cell)) continue;
      if (!first || distanceToCell(a, cell) < distanceToCell(a, *first)) first = cell;
    }
  return first;
}

// In cells; of several the one nearest to `a`.
std::optional<Cell> firstOnPiece(const OccupancyGrid& map, int occupied_min, const Vector2d& a,
                                 const Vector2d& b, double radius) {
  const Vector2d low = a.cwiseMin(b).array() - radius;
  const Vector2d high = a.cwiseMax(b).array() + radius;
  return nearestCell(cellsBetween(map.geometry(), low, high), a, [&](Cell cell) {
    return map[cell] >= occupied_min && tooNear(a, b, cell, radius);
  });
}

std::optional<Cell> unknownOnPiece(const OccupancyGrid& map, const OccupancyThresholds& thresholds,
                                   const Vector2d& a, const Vector2d& b) {
  return nearestCell(cellsBetween(map.geometry(), a.cwiseMin(b), a.cwiseMax(b)), a, [&](Cell cell) {
    return thresholds.classify(map[cell]) == Occupancy::UNKNOWN && entryInto(a, b, cell);
  });
}

bool isOutside(const OccupancyGrid& map, const Vector2d& point) {
  return point.x() < 0.0 || point.y() < 0.0 || point.x() > map.width() || point.y() > map.height();
}

// Metres from `point` to the nearest occupied cell, at most `radius`.
double clearanceAt(const OccupancyGrid& map, int occupied_min, const Eigen::Vector3d& point,
                   double radius) {
  const double resolution = map.geometry().resolution();
  const Vector2d at = map.geometry().gridFromWorld(point.head<2>());
  const Vector2d low = at.array() - radius / resolution;
  const Vector2d high = at.array() + radius / resolution;
  const auto nearest = nearestCell(cellsBetween(map.geometry(), low, high), at,
                                   [&](Cell cell) { return map[cell] >= occupied_min; });
  return nearest ? std::min(radius, resolution * distanceToCell(at, *nearest)) : radius;
}

std::optional<Obstruction> firstUnknown(const OccupancyGrid& map,
                                        const OccupancyThresholds& thresholds,
                                        const std::vector<Eigen::Vector3d>& ahead) {
  std::optional<Obstruction> found;
  visitPieces(map.geometry(), ahead, [&](const Vector2d& from, const Vector2d& to) {
    if (const auto cell = unknownOnPiece(map, thresholds, from, to))
      found = {Obstruction::Kind::UNKNOWN, map.geometry().centre(*cell)};
    else if (isOutside(map, from) || isOutside(map, to))
      found = {Obstruction::Kind::OUTSIDE,
               map.geometry().worldFromGrid(isOutside(map, from) ? from : to)};
    return found.has_value();
  });
  return found;
}

}  // namespace

std::optional<Cell> firstOccupied(const OccupancyGrid& map, int occupied_min,
                                  const std::vector<Eigen::Vector3d>& ahead, double radius) {
  const double radius_cells = radius / map.geometry().resolution();
  std::optional<Cell> found;
  visitPieces(map.geometry(), ahead, [&](const Vector2d& from, const Vector2d& to) {
    found = firstOnPiece(map, occupied_min, from, to, radius_cells);
    return found.has_value();
  });
  return found;
}

std::optional<Obstruction> firstObstruction(const OccupancyGrid& map, const ClearanceLimits& limits,
                                            const std::vector<Eigen::Vector3d>& ahead) {
  if (ahead.empty()) return std::nullopt;
  const int occupied_min = limits.thresholds.occupied_min;
  const auto join =
      ahead.begin() + std::min<std::ptrdiff_t>(2, static_cast<std::ptrdiff_t>(ahead.size()));
  std::optional<Cell> cell =
      firstOccupied(map, occupied_min, {ahead.begin(), join},
                    clearanceAt(map, occupied_min, ahead.front(), limits.radius));
  if (!cell && ahead.size() > 2)
    cell = firstOccupied(map, occupied_min, {ahead.begin() + 1, ahead.end()}, limits.radius);
  if (cell) return Obstruction{Obstruction::Kind::OCCUPIED, map.geometry().centre(*cell)};
  return limits.stop_at_unknown ? firstUnknown(map, limits.thresholds, ahead) : std::nullopt;
}

}  // namespace grid_path_planner::following
