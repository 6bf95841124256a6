#include "grid_path_planner/costmap/line_of_sight.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "costmap/centre_lattice.h"

namespace grid_path_planner::costmap {

using grid::Cell;

namespace {

constexpr std::int64_t kUnit = SegmentPoint::kUnitsPerCell;
constexpr std::int64_t kHalf = kUnit / 2;

std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
  return a / b - ((a % b != 0) && ((a < 0) != (b < 0)));
}
std::int64_t ceilDivide(std::int64_t a, std::int64_t b) {
  return -floorDivide(-a, b);
}

// A line along its major axis: from left to right, never steeper than 45 degrees. cell() gives the
// map's cell, transposed back.
class Line {
 public:
  Line(SegmentPoint from, SegmentPoint to)
      : transposed_(std::abs(to.y - from.y) > std::abs(to.x - from.x)) {
    if (transposed_) {
      std::swap(from.x, from.y);
      std::swap(to.x, to.y);
    }
    if (from.x > to.x) std::swap(from, to);
    begin_ = from;
    dx_ = to.x - from.x;
    dy_ = to.y - from.y;
  }

  std::int64_t left() const { return begin_.x; }
  std::int64_t right() const { return begin_.x + dx_; }
  double lengthPerUnit() const { return std::hypot(double(dx_), double(dy_)) / double(dx_); }

  // The rows whose interior the line enters between x = a and x = b, inside one column; where it
  // runs along an edge, the two rows beside it.
  struct Rows {
    std::int64_t first;
    std::int64_t last;
    bool along_edge;
  };
  Rows rowsBetween(std::int64_t a, std::int64_t b) const {
    const std::int64_t at_a = height(a);
    const std::int64_t at_b = height(b);
    const std::int64_t row = dx_ * kUnit;
    if (at_a == at_b) {
      const std::int64_t below = floorDivide(at_a, row);
      const bool edge = below * row == at_a;
      return {edge ? below - 1 : below, below, edge};
    }
    return {floorDivide(std::min(at_a, at_b), row), ceilDivide(std::max(at_a, at_b), row) - 1,
            false};
  }

  // Whether the line passes a lattice point at the lattice line x; `row`: whose lower edge the
  // point lies on.
  bool latticePointAt(std::int64_t x, std::int64_t& row) const {
    row = floorDivide(height(x), dx_ * kUnit);
    return row * dx_ * kUnit == height(x);
  }

  Cell cell(std::int64_t column, std::int64_t row) const {
    const auto c = static_cast<int>(column);
    const auto r = static_cast<int>(row);
    return transposed_ ? Cell{r, c} : Cell{c, r};
  }

 private:
  // y at x, times dx.
  std::int64_t height(std::int64_t x) const { return begin_.y * dx_ + dy_ * (x - begin_.x); }

  bool transposed_;
  SegmentPoint begin_;
  std::int64_t dx_ = 0;
  std::int64_t dy_ = 0;
};

// Whether the lattice point at the lower left corner of cell (column, row) is no pinch: no blocked
// diagonal pair between two passable cells. (With a third cell blocked no line passes through; one
// may end there.)
bool latticePointOpen(const CostGrid& map, const Line& line, std::int64_t column,
                      std::int64_t row) {
  const bool lower_left = map.passable(line.cell(column - 1, row - 1));
  const bool lower_right = map.passable(line.cell(column, row - 1));
  const bool upper_left = map.passable(line.cell(column - 1, row));
  const bool upper_right = map.passable(line.cell(column, row));
  const bool rising = lower_left && upper_right && !lower_right && !upper_left;
  const bool falling = lower_right && upper_left && !lower_left && !upper_right;
  return !rising && !falling;
}

bool rowsPassable(const CostGrid& map, const Line& line, std::int64_t column,
                  const Line::Rows& rows) {
  if (rows.along_edge)
    return map.passable(line.cell(column, rows.first)) ||
           map.passable(line.cell(column, rows.last));
  for (std::int64_t row = rows.first; row <= rows.last; ++row)
    if (!map.passable(line.cell(column, row))) return false;
  return true;
}

CostGrid::Weight weightOfRows(const CostGrid& map, const Line& line, std::int64_t column,
                              const Line::Rows& rows) {
  const auto weightOf = [&](std::int64_t row) {
    const Cell cell = line.cell(column, row);
    return map.passable(cell) ? map.weight(cell) : CostGrid::kBlocked;
  };
  if (rows.along_edge) {
    const CostGrid::Weight below = weightOf(rows.first);
    const CostGrid::Weight above = weightOf(rows.last);
    if (below == CostGrid::kBlocked || above == CostGrid::kBlocked) return std::max(below, above);
    return std::min(below, above);
  }
  CostGrid::Weight weight = 0;
  for (std::int64_t row = rows.first; row <= rows.last; ++row)
    weight = std::max(weight, weightOf(row));
  return weight;
}

bool pointLegal(const CostGrid& map, SegmentPoint point) {
  const std::int64_t column = floorDivide(point.x, kUnit);
  const std::int64_t row = floorDivide(point.y, kUnit);
  const bool on_column = column * kUnit == point.x;
  const bool on_row = row * kUnit == point.y;
  const auto passable = [&](std::int64_t c, std::int64_t r) {
    return map.passable({static_cast<int>(c), static_cast<int>(r)});
  };
  if (on_column && on_row) {
    const Line upright(point, {point.x + kUnit, point.y});
    const bool any = passable(column, row) || passable(column - 1, row) ||
                     passable(column, row - 1) || passable(column - 1, row - 1);
    return any && (map.motion().cut_corners || latticePointOpen(map, upright, column, row));
  }
  return passable(column, row) || (on_column && passable(column - 1, row)) ||
         (on_row && passable(column, row - 1));
}

bool inside(const CostGrid& map, SegmentPoint point) {
  return point.x >= 0 && point.x <= map.geometry().width() * kUnit && point.y >= 0 &&
         point.y <= map.geometry().height() * kUnit;
}

bool cellsPassable(const CostGrid& map, const Line& line) {
  for (std::int64_t a = line.left(); a < line.right();) {
    const std::int64_t column = floorDivide(a, kUnit);
    const std::int64_t b = std::min((column + 1) * kUnit, line.right());
    if (!rowsPassable(map, line, column, line.rowsBetween(a, b))) return false;
    a = b;
  }
  return true;
}

bool latticePointsOpen(const CostGrid& map, const Line& line) {
  for (std::int64_t x = ceilDivide(line.left(), kUnit) * kUnit; x <= line.right(); x += kUnit) {
    std::int64_t row = 0;
    if (line.latticePointAt(x, row) && !latticePointOpen(map, line, x / kUnit, row)) return false;
  }
  return true;
}

}  // namespace

SegmentPoint SegmentPoint::nearest(const Eigen::Vector2d& cells) {
  return {std::llround(cells.x() * kUnitsPerCell), std::llround(cells.y() * kUnitsPerCell)};
}

SegmentPoint waypointOf(const CostGrid& map, Cell cell) {
  if (map.kernel() == 1) return SegmentPoint::centreOf(cell);
  return SegmentPoint::nearest(map.geometry().gridFromWorld(map.waypoint(cell)));
}

Eigen::Vector2d worldOf(const CostGrid& map, SegmentPoint point) {
  Eigen::Vector2d cells(double(point.x) / double(kUnit), double(point.y) / double(kUnit));
  if (map.kernel() > 1 && map.segmentRule() == SegmentRule::CENTRE_LATTICE) {
    // The middles of the last blocks are rounded to 1/4096, which may be nearer to an obstacle.
    const Cell last{map.geometry().width() - 1, map.geometry().height() - 1};
    const SegmentPoint rounded = waypointOf(map, last);
    const Eigen::Vector2d middle = map.geometry().gridFromWorld(map.waypoint(last));
    if (point.x == rounded.x) cells.x() = middle.x();
    if (point.y == rounded.y) cells.y() = middle.y();
  }
  return map.geometry().worldFromGrid(cells);
}

Cell passableCellAt(const CostGrid& map, SegmentPoint point) {
  const int column = static_cast<int>(point.x / kUnit), row = static_cast<int>(point.y / kUnit);
  for (const Cell cell : {Cell{column, row}, Cell{column - 1, row}, Cell{column, row - 1}})
    if (map.passable(cell)) return cell;
  return {column - 1, row - 1};
}

bool lineOfSight(const CostGrid& map, SegmentPoint from, SegmentPoint to) {
  if (map.segmentRule() == SegmentRule::CENTRE_LATTICE) return inCentreLattice(map, from, to);
  if (!inside(map, from) || !inside(map, to)) return false;
  if (from == to) return pointLegal(map, from);
  const Line line(from, to);
  return cellsPassable(map, line) && (map.motion().cut_corners || latticePointsOpen(map, line));
}

double lineCost(const CostGrid& map, SegmentPoint from, SegmentPoint to) {
  if (from.x == to.x && from.y == to.y) return 0.0;
  assert(map.segmentRule() == SegmentRule::CENTRE_LATTICE || lineOfSight(map, from, to));
  const Line line(from, to);
  std::int64_t weighted = 0;  // weight x length along the major axis
  for (std::int64_t a = line.left(); a < line.right();) {
    const std::int64_t column = floorDivide(a, kUnit);
    const std::int64_t edge = (column + 1) * kUnit;
    const std::int64_t this_centre = column * kUnit + kHalf;
    const std::int64_t next_centre = a < this_centre ? this_centre : this_centre + kUnit;
    const std::int64_t b = std::min(next_centre, line.right());
    CostGrid::Weight weight =
        weightOfRows(map, line, column, line.rowsBetween(a, std::min(b, edge)));
    if (b > edge)
      weight = std::max(weight, weightOfRows(map, line, column + 1, line.rowsBetween(edge, b)));
    weighted += std::int64_t{weight} * (b - a);
    a = b;
  }
  return double(weighted) / double(kUnit) * line.lengthPerUnit() * map.kernel();
}

}  // namespace grid_path_planner::costmap
