// What every cell costs: the map that planners search.
//
// A weight 1..65535 a cell, 0 where the cell is blocked. The cost of a step between neighbours u
// and v is max(weight(u), weight(v)) x length: 1 straight, sqrt 2 (or 1) diagonal, times the
// kernel, so that costs compare between kernels. Constant while it is handed out; several planners
// may read one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/costmap/bit_maps.h"
#include "grid_path_planner/costmap/exact_cost.h"
#include "grid_path_planner/costmap/motion_model.h"
#include "grid_path_planner/costmap/weight_counts.h"
#include "grid_path_planner/grid/double_buffered.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::costmap {

class CostGrid {
 public:
  using Weight = std::uint16_t;
  static constexpr Weight kBlocked = 0;

  CostGrid();
  // `weights` and `classes` have the same geometry. `kernel`: how many cells of the original map a
  // cell of this one is wide; `original`: that map, which the last column and row may reach beyond.
  CostGrid(grid::Grid<Weight> weights, grid::Grid<grid::Occupancy> classes,
           const MotionModel& motion);
  CostGrid(grid::Grid<Weight> weights, grid::Grid<grid::Occupancy> classes,
           const MotionModel& motion, int kernel, const grid::GridGeometry& original);

  const grid::GridGeometry& geometry() const { return weights_.geometry(); }
  const MotionModel& motion() const { return motion_; }
  int kernel() const { return kernel_; }
  const grid::GridGeometry& original() const { return original_; }

  // Outside the map is blocked.
  bool passable(grid::Cell cell) const {
    return weights_.contains(cell) && weights_[cell] != kBlocked;
  }
  // Precondition of both: the cell lies in the map.
  Weight weight(grid::Cell cell) const { return weights_[cell]; }
  grid::Occupancy occupancy(grid::Cell cell) const { return classes_[cell]; }

  const grid::Grid<Weight>& weights() const { return weights_; }
  const grid::Grid<grid::Occupancy>& classes() const { return classes_; }
  // The smallest weight of a passable cell; 0 where there is none.
  Weight minWeight() const { return cheapest_; }
  // The largest; 0 where there is none.
  Weight maxWeight() const { return dearest_; }
  // Whether all passable cells weigh the same.
  bool uniform() const { return cheapest_ == dearest_; }

  // One bit a cell, made at the first asking, then repaired by edits. May be asked by several
  // threads at once; the answer lives as long as this map or a copy of it. Throws Stopped; asked
  // again it begins anew.
  const BitMaps& bitMaps(const base::StopToken& stop) const;

  // Where a path passes through a cell, in metres: the middle of what the original map has of it
  // (a cell's centre; only the last column and row of a kernel differ).
  Eigen::Vector2d waypoint(grid::Cell cell) const;

  // Raised by every change of a map that was published as the next of this one.
  std::uint64_t revision() const { return revision_; }
  void setRevision(std::uint64_t revision) { revision_ = revision; }

  // The bit maps too, where they were made, and the counts of weights from the first edit on.
  std::size_t bytes() const;

  // The cells in which a map differs from another; the classes differ only in some of them.
  struct Change {
    grid::CellRect weights;
    grid::CellRect classes;
  };

  // Changes the map, which is like `before`, in place, in time proportional to `rect` (the first
  // time, to the map): for who made it and has not handed it out, or holds it alone again.
  // write(weights, classes) writes cells of `rect` and no others; if it throws, the map is of no
  // further use.
  template <class Write>
  void edit(const CostGrid& before, const grid::CellRect& rect, Write&& write) {
    write(weights_, classes_);
    finishEdit(before, rect);
  }

  // Makes the map what `with` is, which differs from it by `change`, in time proportional to that;
  // the revision stays.
  void catchUp(const CostGrid& with, const Change& change);

 private:
  struct LazyBitMaps;

  void finishEdit(const CostGrid& before, const grid::CellRect& rect);
  void updateBitMaps(const grid::CellRect& rect);

  grid::Grid<Weight> weights_;
  grid::Grid<grid::Occupancy> classes_;
  MotionModel motion_;
  int kernel_ = 1;
  grid::GridGeometry original_;
  Weight cheapest_ = 0;
  Weight dearest_ = 0;
  std::uint64_t revision_ = 0;
  std::shared_ptr<LazyBitMaps> bit_maps_;  // copies of a map share them until one is edited
  WeightCounts counts_;                    // made by the first edit
};

// For DoubleBuffered<CostGrid, CostGrid::Change>: catchUp().
void copyCells(const CostGrid& from, const CostGrid::Change& change, CostGrid& to);

// Whether one step leads from `from` to `to`: neighbours by the motion model, both passable, no
// corner cut unless that is allowed.
bool stepAllowed(const CostGrid& map, grid::Cell from, grid::Cell to);

// Cost of that step, in cells of the original map x weight. Precondition: stepAllowed.
ExactCost stepCost(const CostGrid& map, grid::Cell from, grid::Cell to);

// Cost of a path of steps. Precondition: every step is allowed.
ExactCost costOfSteps(const CostGrid& map, const std::vector<grid::Cell>& cells);

}  // namespace grid_path_planner::costmap
