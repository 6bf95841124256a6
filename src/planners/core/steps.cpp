#include "planners/core/steps.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::Connectivity, costmap::CostGrid, costmap::MotionModel;
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

}  // namespace grid_path_planner::planners
