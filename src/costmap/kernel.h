// Downsampling: k x k cells become one block, the last partial ones too.
//
// conservative: a block is blocked if any of its cells is; its weight is the largest of its cells.
// A path over open blocks therefore stays on passable cells.
//
// filter2d, as the original study: the class of a block is the sign of the sum over its cells of
// occupied +3, unknown -1, free 0 (positive occupied, negative unknown, zero free), where a cell
// blocked by inflation counts as occupied. The sum is one of integers: a normalised float box
// filter, as cv::filter2D makes it, misjudges blocks whose sum is zero. NOT safe: one obstacle
// among three unknown cells vanishes. The weight is that of the class, or the largest one of
// its inflated free cells.
#pragma once

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/costmap_options.h"

namespace grid_path_planner::costmap {

// Geometry of the blocks: same origin, k times the resolution, sizes rounded up.
grid::GridGeometry blockGeometry(const grid::GridGeometry& cells, int kernel);

// The weight of a class without inflation; kBlocked where it is not passable.
CostGrid::Weight classWeight(grid::Occupancy occupancy, const CostmapOptions& options);

// The blocks that hold cells of a rectangle.
grid::CellRect blocksOf(const grid::CellRect& cells, int kernel);

// Computes the blocks that hold cells of `changed`. Precondition: `weights` and `classes` have
// blockGeometry(full.geometry(), options.kernel). Throws Stopped.
void applyKernel(const CostGrid& full, const CostmapOptions& options, const grid::CellRect& changed,
                 grid::Grid<CostGrid::Weight>& weights, grid::Grid<grid::Occupancy>& classes,
                 const base::StopToken& stop);

}  // namespace grid_path_planner::costmap
