#include "planners/core/move_pruning.h"

#include <cstdlib>

#include "grid_path_planner/grid/prefetch.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::Connectivity, costmap::CostGrid, costmap::DiagonalCost, costmap::MotionModel;
using grid::Cell, grid::CellRect, grid::prefetchRows;

namespace {

bool diagonal(Cell step) {
  return step.column != 0 && step.row != 0;
}

std::uint8_t bitOf(Cell step) {
  for (std::size_t n = 0; n < kSteps.size(); ++n)
    if (kSteps[n] == step) return static_cast<std::uint8_t>(1U << n);
  return 0;
}

// The steps that, after `step`, lead back or to where one straight step would have led: the straight
// step costs at most as much as the more expensive of the two, whatever the weights.
std::uint8_t uselessAfter(Cell step) {
  std::uint8_t useless = 0;
  for (const Cell next : kSteps) {
    const Cell sum{step.column + next.column, step.row + next.row};
    if (std::abs(sum.column) + std::abs(sum.row) <= 1)
      useless = static_cast<std::uint8_t>(useless | bitOf(next));
  }
  return useless;
}

// The natural ones of the `allowed` steps after step `number`, where all passable cells have the
// same weight and corners are not cut; with the forced ones: sideways around a blocked cell that is
// left behind.
std::uint8_t canonicalAfter(std::size_t number, std::uint8_t allowed) {
  const Cell step = kSteps[number];
  unsigned tried = kNaturalInTheOpen[number];
  if (!diagonal(step))
    for (const Cell side : {Cell{step.row, step.column}, Cell{-step.row, -step.column}})
      if ((allowed & bitOf({side.column - step.column, side.row - step.row})) == 0)
        tried |= bitOf(side) | bitOf({side.column + step.column, side.row + step.row});
  return static_cast<std::uint8_t>(allowed & tried);
}

bool canonicalHolds(const MotionModel& motion) {
  return motion.connectivity == Connectivity::EIGHT &&
         motion.diagonal_cost == DiagonalCost::SQRT2 && !motion.cut_corners;
}

}  // namespace

PruningRules::PruningRules(const CostGrid& map)
    : motion_(map.motion()),
      map_uniform_(map.uniform()),
      steps_(map.motion()),
      canonical_(canonicalHolds(map.motion())),
      uniform_(canonical_ && map.uniform()) {
  for (std::size_t step = 0; step < kSteps.size(); ++step) {
    never_[step] = uselessAfter(kSteps[step]);
    for (std::size_t neighbourhood = 0; neighbourhood < 256; ++neighbourhood) {
      const auto mask =
          static_cast<std::uint8_t>(allowed(static_cast<NeighbourhoodClass>(neighbourhood)));
      const bool equal = uniform_ || (canonical_ && neighbourhood == kAllEqual);
      tried_[step][neighbourhood] =
          equal ? canonicalAfter(step, mask) : static_cast<std::uint8_t>(mask & ~never_[step]);
    }
  }
}

bool PruningRules::missing(std::uint32_t steps, unsigned step,
                           NeighbourhoodClass neighbourhood) const {
  if (!uniform_ && !(canonical_ && neighbourhood == kAllEqual)) return false;
  std::uint32_t done = 0;
  for (; steps != 0; steps &= steps - 1) {
    const unsigned known = lowest(steps);
    done |= tried_[known][neighbourhood] | never_[known];
  }
  return (tried_[step][neighbourhood] & ~done) != 0;
}

void MovePruning::begin(const CostGrid& map) {
  classes_.resize(map.geometry().size());
  offsets_ = stepOffsets(map.geometry().width());
  rules_ = PruningRules(map);
}

void MovePruning::build(const CostGrid& map, const StopToken& stop) {
  begin(map);
  update(map, map.geometry().rect(), stop);
}

void MovePruning::update(const CostGrid& map, const CellRect& changed, const StopToken& stop) {
  if (!rules_.fit(map)) rules_ = PruningRules(map);
  const CellRect rect = changed.grown(1).intersection(map.geometry().rect());
  const auto width = static_cast<std::size_t>(map.geometry().width());
  prefetchRows(classes_.data() + map.geometry().index({rect.column, rect.row}).value(), width,
               rect.width, rect.height);
  forEachEight(map, rect, stop,
               [this](std::size_t index, int number, const SimdNeighbourhood& cells) {
                 storeBytes(rules_.neighbourhoodClasses(cells), number, classes_.data() + index);
               });
}

}  // namespace grid_path_planner::planners
