// Heuristics: lower bounds of the cost between two cells, as search keys.
//
// zero, manhattan (4-connected distance), chebyshev (diagonals as long as straights: the "diagonal
// distance with uniform cost"), octile (diagonals sqrt 2: the "non-uniform" one) and euclidean, in
// cell lengths times the scale. With `cheapest` as scale they are computed with integers, rounded
// down, and consistent wherever admissible() says so.
#pragma once

#include <cstdint>
#include <optional>

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planners/a_star_options.h"
#include "planners/core/keys.h"

namespace grid_path_planner::planners {

// Whether it comes from a table that is computed for a map (planners/precomputed_table.h).
bool prepared(Heuristic heuristic);

// The largest of those that are computed without a table which is admissible for `motion`.
Heuristic closedFormFor(const costmap::MotionModel& motion);

// Whether the heuristic, times a scale of at most the minimum weight, never exceeds the cost.
bool admissible(Heuristic heuristic, const costmap::MotionModel& motion);

// Whether A* with these options finds a least-cost path on `map`.
bool optimalWith(const AStarOptions& options, const costmap::CostGrid& map);

// The h-value of A* with `options` from `start` to `goal` on `map`.
class Estimate {
 public:
  Estimate(const AStarOptions& options, const costmap::CostGrid& map, grid::Cell start,
           grid::Cell goal, const KeyScale& scale = kWideScale);

  SearchKey operator()(grid::Cell cell) const {
    const auto columns = static_cast<std::uint64_t>(std::abs(cell.column - goal_.column));
    const auto rows = static_cast<std::uint64_t>(std::abs(cell.row - goal_.row));
    if (integral_ && heuristic_ == Heuristic::OCTILE) return octile(columns, rows) * weight_;
    return general(columns, rows);
  }

  // Whether OctileEstimate gives the same.
  bool plainOctile() const { return integral_ && heuristic_ == Heuristic::OCTILE; }

  // |cross product| of the vectors from the goal to `cell` and to the start: 0 on the straight
  // line.
  std::uint64_t cross(grid::Cell cell) const;

 private:
  SearchKey octile(std::uint64_t columns, std::uint64_t rows) const {
    return columns < rows ? (rows - columns) * scale_.straight + columns * scale_.diagonal
                          : (columns - rows) * scale_.straight + rows * scale_.diagonal;
  }
  SearchKey general(std::uint64_t columns, std::uint64_t rows) const;
  SearchKey distance(std::uint64_t columns, std::uint64_t rows) const;

  KeyScale scale_;
  Heuristic heuristic_;
  grid::Cell start_;
  grid::Cell goal_;
  SearchKey weight_;  // the scale where it is the minimum weight
  double factor_;     // the scale as a number, times epsilon
  bool integral_;     // the estimate is distance * weight_ and fits
};

// The octile distance at the minimum weight, for inner loops.
class OctileEstimate {
 public:
  OctileEstimate(const costmap::CostGrid& map, grid::Cell goal, const KeyScale& scale)
      : goal_(goal),
        straight_(scale.straight * map.minWeight()),
        diagonal_(scale.diagonal * map.minWeight()) {}

  SearchKey operator()(grid::Cell cell) const {
    const auto columns = static_cast<std::uint64_t>(std::abs(cell.column - goal_.column));
    const auto rows = static_cast<std::uint64_t>(std::abs(cell.row - goal_.row));
    const std::uint64_t less = columns < rows ? columns : rows;
    return (columns + rows - 2 * less) * straight_ + less * diagonal_;
  }

 private:
  grid::Cell goal_;
  SearchKey straight_;
  SearchKey diagonal_;
};

}  // namespace grid_path_planner::planners
