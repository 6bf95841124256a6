#include "study/unfilled_border.h"

namespace grid_path_planner::study {

using grid::Cell, grid::GridGeometry, grid::OccupancyGrid;
using path::Path, path::Pose;

namespace {

Cell blockAround(Cell cell, int kernel) {
  return {cell.column / kernel, cell.row / kernel};
}

}  // namespace

bool inUnfilledBlock(Cell cell, const GridGeometry& geometry, int kernel) {
  const Cell block = blockAround(cell, kernel);
  return !geometry.contains({block.column * kernel + kernel / 2, block.row * kernel + kernel / 2});
}

OccupancyGrid withUnfilledBorder(const OccupancyGrid& map, int kernel) {
  OccupancyGrid changed = map;
  const GridGeometry& geometry = map.geometry();
  for (int row = 0; row < geometry.height(); ++row)
    for (int column = 0; column < geometry.width(); ++column)
      if (inUnfilledBlock({column, row}, geometry, kernel)) changed[Cell{column, row}] = 0;
  return changed;
}

std::size_t unfilledBlocksOf(const Path& path, const GridGeometry& geometry, int kernel) {
  std::size_t blocks = 0;
  Cell last{-1, -1};
  for (const Pose& pose : path.poses) {
    const auto cell = geometry.cellAt(pose.position.head<2>());
    if (!cell) continue;
    const Cell block = blockAround(*cell, kernel);
    if (block != last && inUnfilledBlock(*cell, geometry, kernel)) ++blocks;
    last = block;
  }
  return blocks;
}

}  // namespace grid_path_planner::study
