#include "planners/core/steps.h"
#include "planners/jump_point/dead_ends.h"
#include "planners/jump_point/weighted_jump_map.h"

namespace grid_path_planner::planners {

using costmap::CostGrid;
using grid::Cell, grid::CellRect;

namespace {

Cell before(Cell cell, unsigned step) {
  return {cell.column - kSteps[step].column, cell.row - kSteps[step].row};
}

}  // namespace

WeightedJumpMap::ScopedGoal::ScopedGoal(WeightedJumpMap& jumps, const CostGrid& map, Cell goal)
    : jumps_(jumps), map_(map), goal_(goal) {
  jumps_.makeReady(
      map,
      CellRect{goal.column, goal.row, 1, 1}.grown(kDepth + 2).intersection(map.geometry().rect()));
  was_open_ = jumps_.open(goal);
  jumps_.goal_ = goal;
  restoreStepsTo(goal, deadAfter(jumps.steps(map, map.geometry().index(goal).value())));
  for (const Change& change : changes_)
    jumps_.setStops(change.cell, jumps_.steps(map, map.geometry().index(change.cell).value()));
  jumps_.setOpen(goal, false);
  jumps_.setStops(goal, ~NaturalMoves{0});
}

// Makes live the steps of `dead` that lead to the cell, although no step is natural after them, and
// likewise the dead steps that lead to these.
void WeightedJumpMap::ScopedGoal::restoreStepsTo(Cell cell, unsigned dead) {
  struct Entry {
    Cell cell;
    unsigned dead;
  };
  std::vector<Entry> stack = {{cell, dead}};
  while (!stack.empty()) {
    const Entry next = stack.back();
    stack.pop_back();
    for (unsigned bits = next.dead; bits != 0; bits &= bits - 1) {
      const auto step = unsigned(__builtin_ctz(bits));
      const Cell from = before(next.cell, step);
      if (!map_.passable(from)) continue;
      const std::uint32_t index = map_.geometry().index(from).value();
      Mark& mark = jumps_.marks_[index];
      if ((mark.live >> step & 1U) != 0) continue;
      const NaturalMoves natural = jumps_.natural(map_, index);
      const unsigned taken = ~deadAfter(natural & (kEveryByte << step)) & 255U;
      const unsigned was_dead = deadAfter(natural & (mark.live * kEveryByte));
      if (taken == 0) continue;
      changes_.push_back({from, mark.live});
      mark.live |= static_cast<std::uint8_t>(1U << step);
      if ((taken & was_dead) != 0) stack.push_back({from, taken & was_dead});
    }
  }
}

WeightedJumpMap::ScopedGoal::~ScopedGoal() {
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change)
    jumps_.marks_[map_.geometry().index(change->cell).value()].live = change->live;
  jumps_.goal_ = {-1, -1};
  changes_.push_back({goal_, 0});
  for (const Change& change : changes_)
    jumps_.setStops(change.cell, jumps_.steps(map_, map_.geometry().index(change.cell).value()));
  jumps_.setOpen(goal_, was_open_);
}

}  // namespace grid_path_planner::planners
