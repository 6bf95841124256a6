// The exact cost from every cell to the nearest of some goals: one computation that answers any
// number of vehicles, or bounds other searches.
//
//   CostToGo field(map, {Cell{40, 7}}, /*threads=*/2, stop);
//   if (field.reached(cell)) field.cost(cell);   // exact, as an optimal planner would report it
//   std::vector<Cell> path = field.pathFrom(cell);
//
// Guaranteed: every cell from which a path leads to a goal has its least cost, no other cell has
// one, and neither depends on the number of threads. Paths are of least cost. Reading is safe from
// any number of threads.
//
// The map is cut into tiles of 128x128 cells, small enough for a processor's own cache. A thread
// takes the tile with the least key among the new paths at its border, searches it (buckets, natural
// moves; tile_sweep.h where nothing is blocked and all cells weigh the same) and sends the paths that leave it to the tiles around it. Tiles are searched again until no
// new path is cheaper. Few cells are expanded twice, since tiles are searched in the order of keys.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/zeroed_array.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/keys.h"

namespace grid_path_planner::planners {

class CostToGo {
 public:
  // The most that a map of this geometry needs while it is computed: 8 bytes of label a cell (4
  // where no cost reaches 47,321 cells x weight, or cells where all weigh the same), which stay, and 4 that
  // do not; apart from 0.2 MB a thread and what is offered at the borders of tiles.
  static std::size_t bytesFor(const grid::GridGeometry& geometry);

  // Goals that are blocked are reached from nowhere. Throws InputError for no goal, one outside the
  // map and threads < 1; Stopped; TooExpensive for costs from 2.9e9 on.
  CostToGo(std::shared_ptr<const costmap::CostGrid> map, const std::vector<grid::Cell>& goals,
           int threads, const base::StopToken& stop);

  // Precondition of the following: the cell lies in the map; of cost(), keyIn() and pathFrom():
  // reached(cell).
  bool reached(grid::Cell cell) const { return labelOf(cell) != 0; }
  costmap::ExactCost cost(grid::Cell cell) const;
  // The cost without the kernel's factor, as the searches' keys have it: A straight + B diagonal.
  SearchKey keyIn(const KeyScale& scale, grid::Cell cell) const;
  // To the nearest goal, both ends included.
  std::vector<grid::Cell> pathFrom(grid::Cell cell) const;

  // The labels' own scale, in which key() is fastest, of costs over the weight where all cells have the same;
  // kInfiniteKey where a cell is not reached.
  const KeyScale& scale() const { return scale_; }
  SearchKey key(grid::Cell cell) const {
    const SearchKey label = labelOf(cell);
    return label == 0 ? kInfiniteKey : scale_.largest - label;
  }

  const costmap::CostGrid& map() const { return *map_; }
  // Memory that is held, the map excluded.
  std::size_t bytes() const;

 private:
  // Largest key - key, 0 where not reached.
  SearchKey labelOf(grid::Cell cell) const {
    const std::size_t position = positionOf(cell);
    return wide_.size() == 0 ? narrow_[position] : wide_[position];
  }
  std::size_t positionOf(grid::Cell cell) const;
  costmap::ExactCost inCells(grid::Cell cell) const;

  std::shared_ptr<const costmap::CostGrid> map_;
  KeyScale scale_;
  costmap::CostGrid::Weight factor_;  // of all keys
  std::size_t tiles_across_;
  // Tile by tile, in a tile row by row; one of the two is used.
  base::ZeroedArray<std::uint32_t> narrow_;
  base::ZeroedArray<std::uint64_t> wide_;
};

}  // namespace grid_path_planner::planners
