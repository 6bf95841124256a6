#include "costmap/centre_lattice.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace grid_path_planner::costmap {

using grid::Cell;

namespace {

constexpr std::int64_t kUnit = SegmentPoint::kUnitsPerCell;

// Rounded towards lower numbers. Precondition: b > 0.
std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

// The coordinates of the waypoints along one axis: regular but for the last one of a kernel.
class Centres {
 public:
  Centres(int count, std::int64_t last) : count_(count), last_(last) {}

  std::int64_t first() const { return at(0); }
  std::int64_t last() const { return last_; }
  std::int64_t at(int i) const { return i + 1 == count_ ? last_ : i * kUnit + kUnit / 2; }
  // The last one at or below x. Precondition: first() <= x <= last().
  int below(std::int64_t x) const {
    if (x >= last_) return count_ - 1;
    return std::min(static_cast<int>((x - kUnit / 2) / kUnit), count_ - 2);
  }
  // The first one at or above x. Precondition as before.
  int above(std::int64_t x) const {
    const int low = below(x);
    return at(low) == x ? low : low + 1;
  }

 private:
  int count_;
  std::int64_t last_;
};

// A line along its major axis, from left to right.
class LatticeLine {
 public:
  LatticeLine(const CostGrid& map, SegmentPoint from, SegmentPoint to)
      : map_(map), steep_(std::abs(to.y - from.y) > std::abs(to.x - from.x)) {
    if (steep_) {
      std::swap(from.x, from.y);
      std::swap(to.x, to.y);
    }
    if (from.x > to.x) std::swap(from, to);
    from_ = from;
    to_ = to;
    dx_ = to.x - from.x;
  }

  bool legal() const {
    const Centres major = centres(steep_), minor = centres(!steep_);
    if (from_.x < major.first() || to_.x > major.last()) return false;
    if (std::min(from_.y, to_.y) < minor.first() || std::max(from_.y, to_.y) > minor.last())
      return false;
    if (dx_ == 0)
      return allPassable(major.below(from_.x), major.above(from_.x), minor.below(from_.y),
                         minor.above(from_.y));
    for (std::int64_t a = from_.x; a < to_.x;) {
      const int column = major.below(a);
      const std::int64_t b = std::min(major.at(column + 1), to_.x);
      if (!passable(column, column + 1, minor, a, b)) return false;
      a = b;
    }
    return true;
  }

 private:
  Centres centres(bool rows) const {
    const grid::GridGeometry& geometry = map_.geometry();
    const SegmentPoint last = waypointOf(map_, {geometry.width() - 1, geometry.height() - 1});
    return rows ? Centres(geometry.height(), last.y) : Centres(geometry.width(), last.x);
  }

  // y at x, times dx.
  std::int64_t height(std::int64_t x) const {
    return from_.y * dx_ + (to_.y - from_.y) * (x - from_.x);
  }

  // Whether the centres of all squares, or of the edge or point, are passable in which the line is
  // between x = a and x = b.
  bool passable(int first, int last, const Centres& rows, std::int64_t a, std::int64_t b) const {
    const std::int64_t low = std::min(height(a), height(b)), high = std::max(height(a), height(b));
    return allPassable(first, last, rows.below(floorDivide(low, dx_)),
                       rows.above(-floorDivide(-high, dx_)));
  }

  bool allPassable(int first_column, int last_column, int first_row, int last_row) const {
    for (int column = first_column; column <= last_column; ++column)
      for (int row = first_row; row <= last_row; ++row)
        if (!map_.passable(steep_ ? Cell{row, column} : Cell{column, row})) return false;
    return true;
  }

  const CostGrid& map_;
  bool steep_;
  SegmentPoint from_;
  SegmentPoint to_;
  std::int64_t dx_ = 0;
};

}  // namespace

bool inCentreLattice(const CostGrid& map, SegmentPoint from, SegmentPoint to) {
  return LatticeLine(map, from, to).legal();
}

}  // namespace grid_path_planner::costmap
