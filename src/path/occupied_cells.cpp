#include "path/occupied_cells.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::path {

using grid::Box, grid::CellSpan, grid::columnsInReach, grid::distanceBetween, grid::Occupancy,
    grid::OccupancyGrid, grid::OccupancyThresholds, grid::Segment;

namespace {

Box boxOf(const CellSpan& columns, const CellSpan& rows) {
  return {Eigen::Vector2d(columns.first, rows.first), Eigen::Vector2d(columns.end, rows.end)};
}

}  // namespace

OccupiedCells::OccupiedCells(const OccupancyGrid& map, const OccupancyThresholds& thresholds)
    : map_(map),
      thresholds_(thresholds),
      across_((map.width() + kSide - 1) / kSide),
      up_((map.height() + kSide - 1) / kSide),
      squares_(static_cast<std::size_t>(across_) * up_, Square::NOT_ASKED_YET) {
  const int least = std::clamp(thresholds.occupied_min, 0, 127);
  carry_ = kOnes * static_cast<std::uint64_t>(128 - std::max(least, 1));
  any_ = least == 0;
}

double OccupiedCells::distanceTo(const Segment& segment, double limit) {
  const Eigen::Vector2d low = segment.from.cwiseMin(segment.to);
  const Eigen::Vector2d high = segment.from.cwiseMax(segment.to);
  const double reach = limit + kSlack;
  const CellSpan columns((low.x() - reach) / kSide, (high.x() + reach) / kSide, across_);
  const CellSpan rows((low.y() - reach) / kSide, (high.y() + reach) / kSide, up_);
  double least = limit;
  for (int up = rows.first; up < rows.end; ++up)
    for (int across = columns.first; across < columns.end; ++across)
      if (holdsAny(across, up)) lowerInSquare(segment, across, up, least);
  return least;
}

// Square after square in rings around the point's own, or the one that is nearest to it.
double OccupiedCells::distanceTo(const Eigen::Vector2d& point, double limit) {
  const auto own = [](double at, int count) {
    return static_cast<int>(std::clamp(std::floor(at / kSide), 0.0, count - 1.0));
  };
  const int middle = own(point.x(), across_), level = own(point.y(), up_);
  double least = limit;
  const auto ask = [&](int left, int right, int low, int high) {
    const int first = std::max(left, 0), last = std::min(right, across_ - 1);
    if (first > last) return;  // or a tall map's rows would all be visited for nothing
    for (int up = std::max(low, 0); up <= std::min(high, up_ - 1); ++up)
      for (int across = first; across <= last; ++across)
        if (holdsAny(across, up)) lowerInSquare({point, point}, across, up, least);
  };
  ask(middle, middle, level, level);
  const int last = std::max(across_, up_);
  for (int ring = 1; ring < last && (ring - 1.0) * kSide <= least; ++ring) {
    for (const int up : {level - ring, level + ring}) ask(middle - ring, middle + ring, up, up);
    for (const int across : {middle - ring, middle + ring})
      ask(across, across, level - ring + 1, level + ring - 1);
  }
  return least;
}

CellSpan OccupiedCells::cellsOf(int square, int count) {
  const double first = square * kSide;
  return CellSpan(first, first + kSide - 1.0, count);
}

bool OccupiedCells::holdsAny(int across, int up) {
  Square& square = squares_[static_cast<std::size_t>(up) * across_ + across];
  if (square == Square::NOT_ASKED_YET)
    square = looksLikeAny(across, up) ? Square::HOLDS_ANY : Square::EMPTY;
  return square == Square::HOLDS_ANY;
}

bool OccupiedCells::looksLikeAny(int across, int up) const {
  if (any_) return true;
  const CellSpan columns = cellsOf(across, map_.width()), rows = cellsOf(up, map_.height());
  for (int row = rows.first; row < rows.end; ++row) {
    const std::int8_t* const values = map_.row(row);
    std::uint64_t found = 0;
    int column = columns.first;
    for (; column + 8 <= columns.end; column += 8) found |= signs(values + column);
    if (found != 0 || nextIn(row, column, columns.end) < columns.end) return true;
  }
  return false;
}

void OccupiedCells::lowerInSquare(const Segment& segment, int across, int up, double& least) {
  const CellSpan columns = cellsOf(across, map_.width()), rows = cellsOf(up, map_.height());
  if (distanceBetween(segment, boxOf(columns, rows)) >= least) return;
  for (int row = rows.first; row < rows.end; ++row) lowerInRow(segment, row, columns, least);
}

// Among the columns of the square that a part of the segment has in its reach.
void OccupiedCells::lowerInRow(const Segment& segment, int row, const CellSpan& square,
                               double& least) const {
  const auto columns = columnsInReach(segment, row, least + kSlack, map_.width());
  if (!columns) return;
  const int end = std::min(columns->end, square.end);
  for (int column = nextIn(row, std::max(columns->first, square.first), end); column < end;
       column = nextIn(row, column + 1, end)) {
    const Eigen::Vector2d corner(column, row);
    least = std::min(least, distanceBetween(segment, {corner, corner + Eigen::Vector2d(1.0, 1.0)}));
  }
}

// The first occupied column from `column` on; `end` where none is.
int OccupiedCells::nextIn(int row, int column, int end) const {
  const std::int8_t* const values = map_.row(row);
  while (column < end) {
    if (column + 8 <= end && !any_ && signs(values + column) == 0) {
      column += 8;
    } else if (thresholds_.classify(values[column]) == Occupancy::OCCUPIED) {
      return column;
    } else {
      ++column;
    }
  }
  return end;
}

}  // namespace grid_path_planner::path
