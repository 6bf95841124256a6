#include "grid_path_planner/planners/steps.h"

namespace grid_path_planner::planners {

using base::StopPoll;
using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::MotionModel;
using costmap::stepAllowed;
using grid::Cell;
using grid::CellRect;

static_assert(kSteps[oppositeStep(0)].column == -kSteps[0].column &&
              kSteps[oppositeStep(1)].row == -kSteps[1].row &&
              kSteps[oppositeStep(4)].column == -kSteps[4].column &&
              kSteps[oppositeStep(5)].column == -kSteps[5].column);

std::array<std::ptrdiff_t, 8> stepOffsets(int width) {
  std::array<std::ptrdiff_t, 8> offsets{};
  for (std::size_t step = 0; step < kSteps.size(); ++step)
    offsets[step] = std::ptrdiff_t{kSteps[step].row} * width + kSteps[step].column;
  return offsets;
}

StepRules::StepRules(const MotionModel& motion)
    : steps_(motion.connectivity == Connectivity::EIGHT ? Eight{} + 0xFF : Eight{} + 0x0F),
      corners_(motion.cut_corners ? Eight{} : ~Eight{}) {}

void StepMasks::build(const CostGrid& map, const StopToken& stop) {
  masks_.resize(map.geometry().size());
  offsets_ = stepOffsets(map.geometry().width());
  update(map, map.geometry().rect(), stop);
}

void StepMasks::update(const CostGrid& map, const CellRect& changed, const StopToken& stop) {
  const StepRules rules(map.motion());
  forEachEight(map, changed.grown(1).intersection(map.geometry().rect()), stop,
               [&](std::size_t index, int number, const SimdNeighbourhood& cells) {
                 storeBytes(rules.allowed(cells), number, masks_.data() + index);
               });
}

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
