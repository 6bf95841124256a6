#include "costmap/kernel.h"

#include <algorithm>

namespace grid_path_planner::costmap {

using base::StopPoll, base::StopToken;
using grid::Cell, grid::CellRect, grid::Grid, grid::GridGeometry, grid::Occupancy;

namespace {

struct Block {
  CostGrid::Weight weight = CostGrid::kBlocked;
  Occupancy occupancy = Occupancy::FREE;
};

CellRect cellsOf(Cell block, int kernel, const GridGeometry& geometry) {
  return CellRect{block.column * kernel, block.row * kernel, kernel, kernel}.intersection(
      geometry.rect());
}

template <class Visit>
void forEachCell(const CellRect& rect, Visit&& visit) {
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      visit(Cell{column, row});
}

Block conservative(const CostGrid& full, const CellRect& cells) {
  Block block;
  bool blocked = false;
  bool unknown = false;
  bool occupied = false;
  forEachCell(cells, [&](Cell cell) {
    blocked |= full.weight(cell) == CostGrid::kBlocked;
    unknown |= full.occupancy(cell) == Occupancy::UNKNOWN;
    occupied |= full.occupancy(cell) == Occupancy::OCCUPIED;
    block.weight = std::max(block.weight, full.weight(cell));
  });
  if (blocked) block.weight = CostGrid::kBlocked;
  block.occupancy = occupied ? Occupancy::OCCUPIED : unknown ? Occupancy::UNKNOWN : Occupancy::FREE;
  return block;
}

// The class of a cell; occupied where inflation blocks it, but not where its own class does.
Occupancy effectiveClass(const CostGrid& full, Cell cell, const CostmapOptions& options) {
  const Occupancy occupancy = full.occupancy(cell);
  const bool blocked_by_inflation = full.weight(cell) == CostGrid::kBlocked &&
                                    classWeight(occupancy, options) != CostGrid::kBlocked;
  return blocked_by_inflation ? Occupancy::OCCUPIED : occupancy;
}

Block filter2d(const CostGrid& full, const CellRect& cells, const CostmapOptions& options) {
  int sum = 0;
  CostGrid::Weight inflated = 0;
  forEachCell(cells, [&](Cell cell) {
    const Occupancy occupancy = effectiveClass(full, cell, options);
    sum += occupancy == Occupancy::OCCUPIED ? 3 : occupancy == Occupancy::UNKNOWN ? -1 : 0;
    if (occupancy == Occupancy::FREE) inflated = std::max(inflated, full.weight(cell));
  });
  Block block;
  block.occupancy = sum > 0 ? Occupancy::OCCUPIED : sum < 0 ? Occupancy::UNKNOWN : Occupancy::FREE;
  block.weight = classWeight(block.occupancy, options);
  if (block.weight != CostGrid::kBlocked) block.weight = std::max(block.weight, inflated);
  return block;
}

}  // namespace

GridGeometry blockGeometry(const GridGeometry& cells, int kernel) {
  return GridGeometry((cells.width() + kernel - 1) / kernel, (cells.height() + kernel - 1) / kernel,
                      cells.resolution() * kernel, cells.origin());
}

CellRect blocksOf(const CellRect& cells, int kernel) {
  const Cell first{cells.column / kernel, cells.row / kernel};
  const Cell last{(cells.column + cells.width - 1) / kernel,
                  (cells.row + cells.height - 1) / kernel};
  return {first.column, first.row, last.column - first.column + 1, last.row - first.row + 1};
}

CostGrid::Weight classWeight(Occupancy occupancy, const CostmapOptions& options) {
  switch (occupancy) {
    case Occupancy::FREE:
      return static_cast<CostGrid::Weight>(options.free_weight);
    case Occupancy::UNKNOWN:
      return options.unknown_is_passable ? static_cast<CostGrid::Weight>(options.unknown_weight)
                                         : CostGrid::kBlocked;
    case Occupancy::OCCUPIED:
      break;
  }
  return options.occupied_is_passable ? static_cast<CostGrid::Weight>(options.occupied_weight)
                                      : CostGrid::kBlocked;
}

void applyKernel(const CostGrid& full, const CostmapOptions& options, const CellRect& changed,
                 Grid<CostGrid::Weight>& weights, Grid<Occupancy>& classes, const StopToken& stop) {
  if (changed.empty()) return;
  StopPoll poll(stop, 64);
  const CellRect blocks = blocksOf(changed, options.kernel);
  for (int row = blocks.row; row < blocks.row + blocks.height; ++row) {
    poll();
    for (int column = blocks.column; column < blocks.column + blocks.width; ++column) {
      const Cell cell{column, row};
      const CellRect cells = cellsOf(cell, options.kernel, full.geometry());
      const Block block = options.kernel_rule == KernelRule::CONSERVATIVE
                              ? conservative(full, cells)
                              : filter2d(full, cells, options);
      weights[cell] = block.weight;
      classes[cell] = block.occupancy;
    }
  }
}

}  // namespace grid_path_planner::costmap
