#include "planners/astar/heuristic.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::planners {

using costmap::Connectivity, costmap::CostGrid, costmap::DiagonalCost, costmap::MotionModel;
using grid::Cell;

namespace {

SearchKey roundedDown(long double key) {
  if (key >= static_cast<long double>(kInfiniteKey)) return kInfiniteKey;
  return key <= 0.0L ? 0 : static_cast<SearchKey>(key);
}

}  // namespace

Heuristic closedFormFor(const MotionModel& motion) {
  if (motion.connectivity == Connectivity::FOUR) return Heuristic::MANHATTAN;
  return motion.diagonal_cost == DiagonalCost::UNIT ? Heuristic::CHEBYSHEV : Heuristic::OCTILE;
}

bool prepared(Heuristic heuristic) {
  return heuristic == Heuristic::BLOCKS || heuristic == Heuristic::LANDMARK ||
         heuristic == Heuristic::EXACT;
}

bool admissible(Heuristic heuristic, const MotionModel& motion) {
  const bool four = motion.connectivity == Connectivity::FOUR;
  const bool root = motion.diagonal_cost == DiagonalCost::SQRT2;
  switch (heuristic) {
    case Heuristic::ZERO:
    case Heuristic::CHEBYSHEV:
    case Heuristic::BLOCKS:
    case Heuristic::LANDMARK:
    case Heuristic::EXACT:
      return true;
    case Heuristic::MANHATTAN:
      return four;
    case Heuristic::OCTILE:
    case Heuristic::EUCLIDEAN:
      return four || root;
  }
  return false;
}

bool optimalWith(const AStarOptions& options, const CostGrid& map) {
  const std::optional<double> scale = heuristicScale(options);
  const bool scale_bounds = !scale || *scale <= map.minWeight();
  return options.epsilon == 1.0 && scale_bounds && admissible(options.heuristic, map.motion());
}

Estimate::Estimate(const AStarOptions& options, const CostGrid& map, Cell start, Cell goal,
                   const KeyScale& scale)
    : scale_(scale),
      heuristic_(prepared(options.heuristic) ? closedFormFor(map.motion()) : options.heuristic),
      start_(start),
      goal_(goal),
      weight_(map.minWeight()),
      factor_(heuristicScale(options).value_or(map.minWeight()) * options.epsilon) {
  // The longest estimate, octile or euclidean, is below (width + height) * weight straight steps.
  const std::uint64_t longest =
      static_cast<std::uint64_t>(map.geometry().width()) + map.geometry().height();
  const bool fits = weight_ == 0 || longest <= kInfiniteKey / (2 * scale_.straight * weight_);
  integral_ = fits && options.epsilon == 1.0 && !heuristicScale(options);
}

std::uint64_t Estimate::cross(Cell cell) const {
  const std::int64_t x1 = cell.column - goal_.column;
  const std::int64_t y1 = cell.row - goal_.row;
  const std::int64_t x2 = start_.column - goal_.column;
  const std::int64_t y2 = start_.row - goal_.row;
  return static_cast<std::uint64_t>(std::abs(x1 * y2 - x2 * y1));
}

SearchKey Estimate::distance(std::uint64_t columns, std::uint64_t rows) const {
  switch (heuristic_) {
    case Heuristic::ZERO:
      return 0;
    case Heuristic::MANHATTAN:
      return (columns + rows) * scale_.straight;
    case Heuristic::CHEBYSHEV:
      return std::max(columns, rows) * scale_.straight;
    case Heuristic::OCTILE:
      return octile(columns, rows);
    case Heuristic::EUCLIDEAN:
    case Heuristic::BLOCKS:
    case Heuristic::LANDMARK:
    case Heuristic::EXACT:
      break;
  }
  // One unit below: the rounding of the square root must not lift it above the true length.
  const long double length = std::sqrt(static_cast<long double>(columns * columns + rows * rows));
  const SearchKey key = roundedDown(length * static_cast<long double>(scale_.straight));
  return key > 0 ? key - 1 : 0;
}

SearchKey Estimate::general(std::uint64_t columns, std::uint64_t rows) const {
  const SearchKey cells = distance(columns, rows);
  if (integral_) return cells * weight_;
  return roundedDown(static_cast<long double>(cells) * static_cast<long double>(factor_));
}

}  // namespace grid_path_planner::planners
