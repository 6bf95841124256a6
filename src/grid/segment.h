// A straight piece of a path against rectangles, in the plane and in any one unit.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

namespace grid_path_planner::grid {

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

// The columns of a row in which cells are within `reach` of the segment are among these; none where there are none.
inline std::optional<CellSpan> columnsInReach(const Segment& segment, int row, double reach,
                                              int width) {
  const auto [low, high] = std::minmax(segment.from.x(), segment.to.x());
  const auto near = clipped(segment, {{low, row - reach}, {high, row + 1.0 + reach}});
  if (!near) return std::nullopt;
  const auto [left, right] = std::minmax(near->from.x(), near->to.x());
  return CellSpan(left - reach, right + reach, width);
}

// Calls visit(row, columns) for the rows of a map of width x height cells, in whose unit the segment
// is, that have cells within `reach` of it; all of these are among `columns`.
template <class Visit>
void forEachRowInReach(const Segment& segment, double reach, int width, int height, Visit&& visit) {
  const auto [low, high] = std::minmax(segment.from.y(), segment.to.y());
  const CellSpan rows(low - reach, high + reach, height);
  for (int row = rows.first; row < rows.end; ++row)
    if (const auto columns = columnsInReach(segment, row, reach, width)) visit(row, *columns);
}

}  // namespace grid_path_planner::grid
