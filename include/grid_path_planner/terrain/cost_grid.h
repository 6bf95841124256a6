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

#include "grid_path_planner/grid/map_turns.h"
#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/terrain/bit_maps.h"
#include "grid_path_planner/terrain/exact_cost.h"
#include "grid_path_planner/terrain/motion_model.h"
#include "grid_path_planner/terrain/weight_counts.h"

namespace grid_path_planner {

class CostGrid {
 public:
  using Weight = std::uint16_t;
  static constexpr Weight kBlocked = 0;

  CostGrid();
  // `weights` and `classes` have the same geometry. `kernel`: how many cells of the original map a
  // cell of this one is wide; `original`: that map, which the last column and row may reach beyond.
  CostGrid(Grid<Weight> weights, Grid<Occupancy> classes, const MotionModel& motion);
  CostGrid(Grid<Weight> weights, Grid<Occupancy> classes, const MotionModel& motion, int kernel,
           const GridGeometry& original);

  const GridGeometry& geometry() const { return weights_.geometry(); }
  const MotionModel& motion() const { return motion_; }
  int kernel() const { return kernel_; }
  const GridGeometry& original() const { return original_; }

  // Outside the map is blocked.
  bool passable(Cell cell) const { return weights_.contains(cell) && weights_[cell] != kBlocked; }
  // Precondition of both: the cell lies in the map.
  Weight weight(Cell cell) const { return weights_[cell]; }
  Occupancy occupancy(Cell cell) const { return classes_[cell]; }

  const Grid<Weight>& weights() const { return weights_; }
  const Grid<Occupancy>& classes() const { return classes_; }
  // The smallest weight of a passable cell; 0 where there is none.
  Weight cheapest() const { return cheapest_; }
  // The largest; 0 where there is none.
  Weight dearest() const { return dearest_; }
  // Whether all passable cells weigh the same.
  bool uniform() const { return cheapest_ == dearest_; }

  // One bit a cell, made at the first asking, then repaired by edits. May be asked by several
  // threads at once; the answer lives as long as this map or a copy of it. Throws Stopped; asked
  // again it begins anew.
  const BitMaps& bitMaps(const StopToken& stop) const;

  // Where a path passes through a cell, in metres: the middle of what the original map has of it
  // (a cell's centre; only the last column and row of a kernel differ).
  Eigen::Vector2d waypoint(Cell cell) const;

  // Raised by every change of a map that was published as the next of this one.
  std::uint64_t revision() const { return revision_; }
  void setRevision(std::uint64_t revision) { revision_ = revision; }

  // The bit maps too, where they were made, and the counts of weights from the first edit on.
  std::size_t bytes() const;

  // The cells in which a map differs from another; the classes differ only in some of them.
  struct Change {
    CellRect weights;
    CellRect classes;
  };

  // Changes the map, which is like `before`, in place, in time proportional to `rect` (the first
  // time, to the map): for who made it and has not handed it out, or holds it alone again.
  // write(weights, classes) writes cells of `rect` and no others; if it throws, the map is of no
  // further use.
  template <class Write>
  void edit(const CostGrid& before, const CellRect& rect, Write&& write) {
    write(weights_, classes_);
    finishEdit(before, rect);
  }

  // Makes the map what `with` is, which differs from it by `change`, in time proportional to that;
  // the revision stays.
  void catchUp(const CostGrid& with, const Change& change);

 private:
  struct LazyBitMaps;

  void finishEdit(const CostGrid& before, const CellRect& rect);
  void updateBitMaps(const CellRect& rect);

  Grid<Weight> weights_;
  Grid<Occupancy> classes_;
  MotionModel motion_;
  int kernel_ = 1;
  GridGeometry original_;
  Weight cheapest_ = 0;
  Weight dearest_ = 0;
  std::uint64_t revision_ = 0;
  std::shared_ptr<LazyBitMaps> bit_maps_;  // copies of a map share them until one is edited
  WeightCounts counts_;                    // made by the first edit
};

// For MapTurns<CostGrid, CostGrid::Change>: catchUp().
void copyCells(const CostGrid& from, const CostGrid::Change& change, CostGrid& to);

// Whether one step leads from `from` to `to`: neighbours by the motion model, both passable, no
// corner cut unless that is allowed.
bool stepAllowed(const CostGrid& map, Cell from, Cell to);

// Cost of that step, in cells of the original map x weight. Precondition: stepAllowed.
ExactCost stepCost(const CostGrid& map, Cell from, Cell to);

// Cost of a path of steps. Precondition: every step is allowed.
ExactCost costOfSteps(const CostGrid& map, const std::vector<Cell>& cells);

}  // namespace grid_path_planner
