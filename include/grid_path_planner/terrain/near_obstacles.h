// Distances to obstacles that are near, for inflation: what obstacleDistances() of inflation.h
// gives, up to a reach of a few dozen cells, in a fraction of its time.
//
//   NearObstacles near(classes, rect, reach);
//   for (int row = rect.row; row < rect.row + rect.height; ++row)
//     if (const std::int16_t* distances = near.row(row)) use(distances);
//
// Distances are in (half cells)^2, from a cell's centre to the nearest edge of an occupied cell,
// exact up to (2 reach)^2 and kFar or any larger value beyond. Separable: along each row the
// distance to the nearest occupied cell; then down the columns the least over the 2 reach + 1 rows
// around, eight columns at once, rows without an occupied cell left out. Sixteen bits hold it all,
// so the rows around stay in the cache. That is O(reach) a cell and yet the fastest way measured up
// to kLargestReach: in open country there is hardly a row to look at.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner {

class NearObstacles {
 public:
  static constexpr int kLargestReach = 63;
  static constexpr std::int16_t kFar = 32767;

  // Precondition: `rect` lies in the map of `classes`, which outlives this; 0 < reach <=
  // kLargestReach.
  NearObstacles(const Grid<Occupancy>& classes, const CellRect& rect, int reach);

  // The distances of the rectangle's cells in `row`, until the next call; null where all are kFar.
  // Precondition: rows are asked for in order, each once.
  const std::int16_t* row(int row);

 private:
  using Distance = std::int16_t;
  // Eight distances, handled by one instruction where the machine has such.
  using Eight = Distance __attribute__((vector_size(16)));

  // The squared distance of two cells that are `cells` columns or rows apart.
  static constexpr int squared(int cells) {
    return cells == 0 ? 0 : (2 * cells - 1) * (2 * cells - 1);
  }

  Distance* lineOf(int row) {
    return lines_.data() + static_cast<std::size_t>(row % period_) * stride_;
  }
  void measure(int row);
  // Distances along a row to the cells `before` and `next`, for those between, as far as they are
  // of the rectangle. Columns are told from `begin`.
  void fillBetween(int before, int next, int begin, Distance* line) const;

  const Grid<Occupancy>& classes_;
  CellRect rect_;
  int reach_;
  int period_;                     // lines that are kept
  std::size_t stride_;             // of a line, a multiple of eight
  int next_;                       // the row that is measured next
  std::vector<Distance> rising_;   // squares by columns apart, kBeyond where out of reach
  std::vector<Distance> falling_;  // the same backwards
  std::vector<Distance> lines_;    // the rows around, along the rows only
  std::vector<bool> empty_;        // whether a line has no occupied cell in reach
  std::vector<Distance> least_;
  struct Source {
    const Distance* line;
    Eight added;
  };
  std::vector<Source> sources_;  // of one row: the lines around it
};

}  // namespace grid_path_planner
