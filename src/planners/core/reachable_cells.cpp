#include "grid_path_planner/planners/reachable_cells.h"

#include "planners/core/steps.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::CostGrid, costmap::stepAllowed;
using grid::Cell;

std::vector<std::uint8_t> reachableFrom(const CostGrid& map, Cell start, const StopToken& stop) {
  std::vector<std::uint8_t> reached(map.geometry().size(), 0);
  if (!map.passable(start)) return reached;
  StopPoll poll(stop);
  std::vector<Cell> open = {start};
  reached[map.geometry().index(start).value()] = 1;
  while (!open.empty()) {
    poll();
    const Cell from = open.back();
    open.pop_back();
    for (const Cell step : kSteps) {
      const Cell to{from.column + step.column, from.row + step.row};
      if (!map.geometry().contains(to)) continue;
      std::uint8_t& mark = reached[map.geometry().index(to).value()];
      if (mark != 0 || !stepAllowed(map, from, to)) continue;
      mark = 1;
      open.push_back(to);
    }
  }
  return reached;
}

}  // namespace grid_path_planner::planners
