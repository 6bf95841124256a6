#include "grid_path_planner/search/steps.h"

namespace grid_path_planner {
namespace {

std::uint8_t maskOf(const CostGrid& map, Cell cell) {
  std::uint8_t mask = 0;
  for (std::size_t step = 0; step < kSteps.size(); ++step) {
    const Cell to{cell.column + kSteps[step].column, cell.row + kSteps[step].row};
    if (stepAllowed(map, cell, to)) mask = static_cast<std::uint8_t>(mask | (1U << step));
  }
  return mask;
}

// The same for a cell with all eight neighbours in the map: no bounds to look at.
std::uint8_t innerMask(const CostGrid::Weight* at, std::ptrdiff_t width, bool eight, bool cut) {
  if (at[0] == CostGrid::kBlocked) return 0;
  const bool east = at[1] != CostGrid::kBlocked;
  const bool north = at[width] != CostGrid::kBlocked;
  const bool west = at[-1] != CostGrid::kBlocked;
  const bool south = at[-width] != CostGrid::kBlocked;
  unsigned mask =
      unsigned(east) | unsigned(north) << 1 | unsigned(west) << 2 | unsigned(south) << 3;
  if (!eight) return static_cast<std::uint8_t>(mask);
  const auto diagonal = [&](std::ptrdiff_t offset, bool a, bool b) {
    return unsigned(at[offset] != CostGrid::kBlocked && (cut || (a && b)));
  };
  mask |= diagonal(width + 1, east, north) << 4 | diagonal(width - 1, west, north) << 5 |
          diagonal(-width - 1, west, south) << 6 | diagonal(-width + 1, east, south) << 7;
  return static_cast<std::uint8_t>(mask);
}

}  // namespace

void StepMasks::build(const CostGrid& map, const StopToken& stop) {
  masks_.assign(map.geometry().size(), 0);
  for (std::size_t step = 0; step < kSteps.size(); ++step)
    offsets_[step] =
        std::ptrdiff_t{kSteps[step].row} * map.geometry().width() + kSteps[step].column;
  update(map, map.geometry().rect(), stop);
}

void StepMasks::update(const CostGrid& map, const CellRect& changed, const StopToken& stop) {
  const GridGeometry& geometry = map.geometry();
  const CellRect rect = changed.grown(1).intersection(geometry.rect());
  const bool eight = map.motion().connectivity == Connectivity::EIGHT;
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const bool inner_row = row > 0 && row + 1 < geometry.height();
    const CostGrid::Weight* weights = map.weights().row(row);
    for (int column = rect.column; column < rect.column + rect.width; ++column) {
      const bool inner = inner_row && column > 0 && column + 1 < geometry.width();
      masks_[geometry.index({column, row}).value()] =
          inner ? innerMask(weights + column, geometry.width(), eight, map.motion().cut_corners)
                : maskOf(map, {column, row});
    }
  }
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
