// A straight piece of a path against rectangles, in the plane and in any one unit.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

namespace grid_path_planner::path {

struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

// Closed and axis-parallel; `low` is nowhere above `high`.
struct Box {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
};

// The part of the segment that lies in the box; none where they do not meet.
std::optional<Segment> clipped(const Segment& segment, const Box& box);

// The least distance between the two: 0 where they meet.
double distanceBetween(const Segment& segment, const Box& box);

// Rows or columns of a map in reach of an interval.
struct CellSpan {
  CellSpan(double low, double high, int count)
      : first(clamped(std::floor(low), count)), end(clamped(std::floor(high) + 1.0, count)) {}

  static int clamped(double value, int count) {
    return static_cast<int>(std::min(std::max(value, 0.0), double(count)));
  }

  int first;
  int end;
};

// Calls visit(row, columns) for the rows of a map of width x height cells, in whose unit the segment
// is, that have cells within `reach` of it; all of these are among `columns`.
template <class Visit>
void forEachRowInReach(const Segment& segment, double reach, int width, int height, Visit&& visit) {
  const Eigen::Vector2d low = segment.from.cwiseMin(segment.to);
  const Eigen::Vector2d high = segment.from.cwiseMax(segment.to);
  const CellSpan rows(low.y() - reach, high.y() + reach, height);
  for (int row = rows.first; row < rows.end; ++row) {
    // The part of the segment that is near enough to the row.
    const auto near = clipped(segment, {{low.x(), row - reach}, {high.x(), row + 1.0 + reach}});
    if (!near) continue;
    const auto [left, right] = std::minmax(near->from.x(), near->to.x());
    visit(row, CellSpan(left - reach, right + reach, width));
  }
}

}  // namespace grid_path_planner::path
