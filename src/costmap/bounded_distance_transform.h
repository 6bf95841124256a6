// Distances to the nearest obstacle up to a limit, for inflation: those of obstacleDistances() of
// inflation.h, up to a reach of a few dozen cells, in a fraction of its time.
//
//   BoundedDistanceTransform transform(classes, Occupancy::OCCUPIED, sources, rect, reach);
//   for (int row = rect.row; row < rect.row + rect.height; ++row)
//     if (const std::int16_t* distances = transform.row(row)) use(distances);
//
// Distances are in (half cells)^2, from a cell's centre to the nearest edge of a cell of
// `sources` that is of the given class, exact below (2 reach + 1)^2 and any larger value beyond.
// Separable: along each row the distance to the nearest occupied cell; then along the columns the
// least over the 2 reach + 1 rows around, a cache line of columns at once, from the nearest row
// outwards until no row can give less; rows without an occupied cell are skipped. Values have
// sixteen bits, so that the rows around stay in the cache. That is O(reach) for a cell and yet the
// fastest method measured up to kLargestReach: where obstacles are rare hardly a row is read.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::costmap {

class BoundedDistanceTransform {
 public:
  static constexpr int kLargestReach = 63;

  // Precondition: `rect` and `sources` lie in the map of `classes`, which outlives this; 0 < reach
  // <= kLargestReach.
  BoundedDistanceTransform(const grid::Grid<grid::Occupancy>& classes, grid::Occupancy source,
                           const grid::CellRect& sources, const grid::CellRect& rect, int reach);

  // The distances of the rectangle's cells in `row`, valid until the next call; null where all are
  // beyond the reach. Precondition: called for every row once, in order.
  const std::int16_t* row(int row);

 private:
  using Distance = std::int16_t;
  static constexpr std::size_t kTogether = 8;
  // Eight distances, processed by one SIMD instruction where the machine has such.
  using Eight = Distance __attribute__((vector_size(2 * kTogether)));
  // Of a cache line, for which one looks at lines together.
  static constexpr std::size_t kEights = 4;
  using Eights = std::array<Eight, kEights>;

  static Eight from(const Distance* distances) {
    Eight eight;
    std::memcpy(&eight, distances, sizeof eight);
    return eight;
  }
  static bool any(Eight signs) {
    using Halves = std::int64_t __attribute__((vector_size(16)));
    const auto halves = reinterpret_cast<Halves>(signs);
    return (halves[0] | halves[1]) != 0;
  }

  static int largest(const Eights& eights) {
    Eight most = eights[0];
    for (const Eight& each : eights) most = most > each ? most : each;
    int all = 0;
    for (std::size_t i = 0; i < kTogether; ++i) all = std::max<int>(all, most[i]);
    return all;
  }

  // The squared distance of two cells that are `cells` columns or rows apart.
  static constexpr int squared(int cells) {
    return cells == 0 ? 0 : (2 * cells - 1) * (2 * cells - 1);
  }

  void measure(int row);
  void append(int row, const Distance* distances);
  // Writes the distances along a row to the nearer one of the occupied cells `before` and `next`,
  // for the cells between them that lie in the rectangle. Columns count from the window's first.
  void fillBetween(int before, int next, Distance* line) const;
  // The distances of `row` in the columns from `first` on. Lines from `above` on belong to `row` and
  // the rows after it.
  Eights least(int row, std::size_t above, std::size_t first) const;

  const grid::Grid<grid::Occupancy>& classes_;
  grid::Occupancy source_;
  grid::CellRect rect_;
  grid::CellRect window_;  // the part of the sources that is in reach of the rectangle
  int reach_;
  int period_;                     // lines in memory_
  std::size_t stride_;             // length of a line, a multiple of Eights
  int next_;                       // the next row to be measured
  std::vector<Distance> rising_;   // squares by columns apart, kBeyond where out of reach
  std::vector<Distance> falling_;  // the same backwards
  std::vector<Distance> memory_;   // of the lines
  struct Line {
    int row;
    const Distance* distances;  // along the row only
    // Whether this line gives no cell a smaller distance than the line before, or after: for rows
    // beyond that line this one is skipped.
    bool dominated_by_previous = false;
    bool dominated_by_next = false;
  };
  std::vector<Line> lines_;   // of the rows in reach that have an occupied cell
  std::vector<Eight> apart_;  // the squares of rows apart
  std::vector<Distance> least_;
};

}  // namespace grid_path_planner::costmap
