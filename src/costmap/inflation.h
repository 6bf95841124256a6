// Inflation: cells near those of one class, the sources, or near the map's border are blocked or
// become more expensive.
//
// The distance is from a cell's centre to the nearest edge of a source, exact: the integer
// (2 distance / resolution)^2. Below the radius a cell is blocked; beyond it weight = max(class
// weight, free + (inflation_weight - free) e^(-decay (distance - radius))), rounded.
//
// The distances come from a separable exact distance transform (Felzenszwalb & Huttenlocher 2012)
// over the edges of the cells: time in proportion to the cells, whatever the radius. Up to a reach
// of 63 cells bounded_distance_transform.h is faster.
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

// From the centre of every cell of `rect` to the nearest edge of a cell of `classes` that is
// `source`, row-major over `rect`. Those more than `reach` columns or rows outside `rect` do not
// count; kNoObstacle where no other is. Precondition: `rect` lies in the map. Throws Stopped.
std::vector<HalfCellsSquared> obstacleDistances(const grid::Grid<grid::Occupancy>& classes,
                                                grid::Occupancy source, const grid::CellRect& rect,
                                                int reach, const base::StopToken& stop);

// How weights fall with the distance: blocked below `radius`, beyond it as `options` say if there
// is a decay.
struct InflationProfile {
  double radius = 0.0;  // m
  double decay = 0.0;   // 1/m
  int free_weight = 1;
  int inflation_weight = 1;
};

// The weights that distances to sources give.
class Inflation {
 public:
  Inflation(grid::Occupancy source, const InflationProfile& profile, double resolution);

  // Whether no weight changes at any distance.
  bool none() const { return reach_ == 0; }
  // Sources farther away than this many columns or rows change nothing.
  int reach() const { return reach_; }

  // Raises the weights of `rect` to those that the sources in `sources` give, and lowers none;
  // sources outside `sources` may count or not. So `sources` is the whole map where `weights` are
  // those of the classes, and the cells that became sources where they are inflated already. Throws
  // Stopped. Precondition: both rectangles lie in the map.
  void apply(const grid::Grid<grid::Occupancy>& classes, const grid::CellRect& sources,
             const grid::CellRect& rect, grid::Grid<CostGrid::Weight>& weights,
             const base::StopToken& stop) const;
  // What apply() does for one source, faster. Preconditions: hasStamp(); the cell lies in the map.
  void raiseAround(grid::Cell source, grid::Grid<CostGrid::Weight>& weights) const;
  bool hasStamp() const { return stamp_stride_ > 0; }

  // The same for the distances to the map's border. Throws Stopped.
  void applyBorder(const grid::CellRect& rect, grid::Grid<CostGrid::Weight>& weights,
                   const base::StopToken& stop) const;

 private:
  // A weight less one, so that blocked, which is 0, is the largest.
  using Rank = std::uint16_t;
  static CostGrid::Weight atLeast(Rank rank, CostGrid::Weight weight) {
    return static_cast<CostGrid::Weight>(std::max(rank, static_cast<Rank>(weight - 1)) + 1);
  }

  void applyNear(const grid::Grid<grid::Occupancy>& classes, const grid::CellRect& sources,
                 const grid::CellRect& rect, grid::Grid<CostGrid::Weight>& weights,
                 const base::StopToken& stop) const;
  void applyFar(const grid::Grid<grid::Occupancy>& classes, const grid::CellRect& rect,
                grid::Grid<CostGrid::Weight>& weights, const base::StopToken& stop) const;
  Rank rankAt(HalfCellsSquared distance) const;
  // The largest one inside the radius, that of the inflated weight beyond, 0 beyond the reach.
  Rank computeRank(HalfCellsSquared distance) const;

  grid::Occupancy source_;
  double radius_;  // half cells
  double decay_;   // 1 / half cell
  double free_;
  double rise_;  // inflation_weight - free_weight
  int reach_ = 0;
  HalfCellsSquared farthest_ = 0;  // beyond it nothing changes
  std::vector<Rank> ranks_;        // computeRank(), up to farthest_ + 1 if that is not too long

  // The ranks around a source, from its row to that `reach_` rows away; rows are filled up with
  // zeros to whole vectors. Empty where the reach is long.
  void makeStamp();
  std::vector<Rank> stamp_;
  std::size_t stamp_stride_ = 0;
};

}  // namespace grid_path_planner::costmap
