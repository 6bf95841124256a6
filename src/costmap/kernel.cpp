#include "costmap/kernel.h"

#include <algorithm>

namespace grid_path_planner::costmap {

using base::StopPoll;
using base::StopToken;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using grid::Occupancy;

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

Block conservative(const CostGrid& fine, const CellRect& cells) {
  Block block;
  bool blocked = false;
  bool unknown = false;
  bool occupied = false;
  forEachCell(cells, [&](Cell cell) {
    blocked |= fine.weight(cell) == CostGrid::kBlocked;
    unknown |= fine.occupancy(cell) == Occupancy::UNKNOWN;
    occupied |= fine.occupancy(cell) == Occupancy::OCCUPIED;
    block.weight = std::max(block.weight, fine.weight(cell));
  });
  if (blocked) block.weight = CostGrid::kBlocked;
  block.occupancy = occupied ? Occupancy::OCCUPIED : unknown ? Occupancy::UNKNOWN : Occupancy::FREE;
  return block;
}

// Passable free and unknown cells keep their class; what inflation blocks counts as occupied, and
// so does nothing else that is only impassable by its class.
Occupancy effectiveClass(const CostGrid& fine, Cell cell, const CostmapOptions& options) {
  const Occupancy occupancy = fine.occupancy(cell);
  const bool inflated = fine.weight(cell) == CostGrid::kBlocked &&
                        classWeight(occupancy, options) != CostGrid::kBlocked;
  return inflated ? Occupancy::OCCUPIED : occupancy;
}

Block filter2d(const CostGrid& fine, const CellRect& cells, const CostmapOptions& options) {
  int sum = 0;
  CostGrid::Weight ring = 0;
  forEachCell(cells, [&](Cell cell) {
    const Occupancy occupancy = effectiveClass(fine, cell, options);
    sum += occupancy == Occupancy::OCCUPIED ? 3 : occupancy == Occupancy::UNKNOWN ? -1 : 0;
    if (occupancy == Occupancy::FREE) ring = std::max(ring, fine.weight(cell));
  });
  Block block;
  block.occupancy = sum > 0 ? Occupancy::OCCUPIED : sum < 0 ? Occupancy::UNKNOWN : Occupancy::FREE;
  block.weight = classWeight(block.occupancy, options);
  if (block.weight != CostGrid::kBlocked) block.weight = std::max(block.weight, ring);
  return block;
}

}  // namespace

GridGeometry blockGeometry(const GridGeometry& cells, int kernel) {
  return GridGeometry((cells.width() + kernel - 1) / kernel, (cells.height() + kernel - 1) / kernel,
                      cells.resolution() * kernel, cells.origin());
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

void applyKernel(const CostGrid& fine, const CostmapOptions& options, const CellRect& changed,
                 Grid<CostGrid::Weight>& weights, Grid<Occupancy>& classes, const StopToken& stop) {
  if (changed.empty()) return;
  StopPoll poll(stop, 64);
  const int k = options.kernel;
  const Cell first{changed.column / k, changed.row / k};
  const Cell last{(changed.column + changed.width - 1) / k, (changed.row + changed.height - 1) / k};
  for (int row = first.row; row <= last.row; ++row) {
    poll();
    for (int column = first.column; column <= last.column; ++column) {
      const Cell block{column, row};
      const CellRect cells = cellsOf(block, k, fine.geometry());
      const Block judged = options.kernel_rule == KernelRule::CONSERVATIVE
                               ? conservative(fine, cells)
                               : filter2d(fine, cells, options);
      weights[block] = judged.weight;
      classes[block] = judged.occupancy;
    }
  }
}

}  // namespace grid_path_planner::costmap
