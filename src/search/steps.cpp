#include "grid_path_planner/search/steps.h"

#include "grid_path_planner/search/neighbourhoods.h"

namespace grid_path_planner {

std::array<std::ptrdiff_t, 8> stepOffsets(int width) {
  std::array<std::ptrdiff_t, 8> offsets{};
  for (std::size_t step = 0; step < kSteps.size(); ++step)
    offsets[step] = std::ptrdiff_t{kSteps[step].row} * width + kSteps[step].column;
  return offsets;
}

NeighbourhoodMasks::NeighbourhoodMasks(const MotionModel& motion) {
  const bool eight = motion.connectivity == Connectivity::EIGHT;
  for (unsigned bits = 0; bits < masks_.size(); ++bits) {
    const auto open = [bits](int columns, int rows) {
      return (bits >> neighbourBit(columns, rows) & 1U) != 0;
    };
    unsigned mask = 0;
    for (std::size_t step = 0; step < kSteps.size(); ++step) {
      const Cell to = kSteps[step];
      const bool straight = to.column == 0 || to.row == 0;
      const bool corner = motion.cut_corners || (open(to.column, 0) && open(0, to.row));
      if (open(0, 0) && open(to.column, to.row) && (straight || (eight && corner)))
        mask |= 1U << step;
    }
    masks_[bits] = static_cast<std::uint8_t>(mask);
  }
}

void StepMasks::build(const CostGrid& map, const StopToken& stop) {
  masks_.resize(map.geometry().size());
  offsets_ = stepOffsets(map.geometry().width());
  update(map, map.geometry().rect(), stop);
}

void StepMasks::update(const CostGrid& map, const CellRect& changed, const StopToken& stop) {
  const NeighbourhoodMasks masks(map.motion());
  forEachNeighbourhood(
      map, changed.grown(1).intersection(map.geometry().rect()), stop,
      [&](std::size_t index, unsigned bits, bool) { masks_[index] = masks[bits]; });
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

}  // namespace grid_path_planner
