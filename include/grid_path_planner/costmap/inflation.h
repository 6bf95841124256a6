// How occupied cells make their surroundings dear or blocked.
//
// The distance is from a cell's centre to the nearest edge of an occupied cell, exact: it is kept
// as the integer (2 distance / resolution)^2. Below `radius` a cell is blocked; beyond it weight =
// max(class weight, free + (inflation_weight - free) e^(-decay (distance - radius))), rounded.
// Unknown cells do not inflate.
//
// The distances come from a separable exact transform (Felzenszwalb & Huttenlocher 2012) over the
// edges of the cells: time in proportion to the cells, whatever the radius. Up to a reach of 63
// cells near_obstacles.h is faster.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/costmap_options.h"

namespace grid_path_planner::costmap {

// Squared distances in units of (resolution / 2)^2.
using HalfCellsSquared = std::int64_t;
constexpr HalfCellsSquared kNoObstacle = -1;

// From the centre of every cell of `rect` to the nearest edge of an occupied cell of `classes`,
// row-major over `rect`. Occupied cells more than `reach` columns or rows outside `rect` are not
// looked at; kNoObstacle where there is none. Precondition: `rect` lies in the map. Throws Stopped.
std::vector<HalfCellsSquared> obstacleDistances(const grid::Grid<grid::Occupancy>& classes,
                                                const grid::CellRect& rect, int reach,
                                                const base::StopToken& stop);

// What a distance does to a weight.
class Inflation {
 public:
  Inflation(const CostmapOptions& options, double resolution);

  // Whether it changes nothing at any distance.
  bool none() const { return reach_ == 0; }
  // Occupied cells farther than this many columns or rows change nothing.
  int reach() const { return reach_; }

  // Makes the cells of `rect` as dear as the occupied cells of `sources` ask for, and none cheaper;
  // those outside `sources` may count or not. So weights of classes become inflated ones where
  // `sources` is the map, and what was inflated takes in cells that have become occupied since
  // where `sources` holds those. Throws Stopped. Precondition: both lie in the map.
  void apply(const grid::Grid<grid::Occupancy>& classes, const grid::CellRect& sources,
             const grid::CellRect& rect, grid::Grid<CostGrid::Weight>& weights,
             const base::StopToken& stop) const;

 private:
  // A weight less one: blocked, which is 0, is the dearest then.
  using Dearness = std::uint16_t;
  static CostGrid::Weight atLeast(Dearness dearness, CostGrid::Weight weight) {
    return static_cast<CostGrid::Weight>(std::max(dearness, static_cast<Dearness>(weight - 1)) + 1);
  }

  void applyNear(const grid::Grid<grid::Occupancy>& classes, const grid::CellRect& sources,
                 const grid::CellRect& rect, grid::Grid<CostGrid::Weight>& weights,
                 const base::StopToken& stop) const;
  void applyFar(const grid::Grid<grid::Occupancy>& classes, const grid::CellRect& rect,
                grid::Grid<CostGrid::Weight>& weights, const base::StopToken& stop) const;
  Dearness dearnessAt(HalfCellsSquared distance) const;
  // Of a blocked cell inside the radius, of the ring's weight beyond, least beyond the reach.
  Dearness dearnessOf(HalfCellsSquared distance) const;

  double radius_;  // half cells
  double decay_;   // 1 / half cell
  double free_;
  double rise_;  // inflation_weight - free_weight
  int reach_ = 0;
  HalfCellsSquared farthest_ = 0;  // beyond it nothing changes
  std::vector<Dearness> table_;    // dearnessOf(), up to farthest_ + 1 if that is not too long
};

}  // namespace grid_path_planner::costmap
