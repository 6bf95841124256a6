// The costmap that planners search: a weight for every cell.
//
// Weights are 1..65535, and 0 where the cell is blocked. The cost of a step between neighbours u
// and v is max(weight(u), weight(v)) x length: 1 straight, sqrt 2 (or 1) diagonal, times the
// kernel, so that costs compare between kernels. A map that others hold does not change, so several
// planners may read it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/costmap/bit_maps.h"
#include "grid_path_planner/costmap/exact_cost.h"
#include "grid_path_planner/costmap/motion_model.h"
#include "grid_path_planner/grid/double_buffered.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::costmap {

class CostGrid {
 public:
  using Weight = std::uint16_t;
  static constexpr Weight kBlocked = 0;

  CostGrid();
  // `weights` and `classes` have the same geometry. `kernel`: the side of a cell in cells of the
  // original map; `original`: the geometry of that map, which ends inside the last column and row
  // where its sides are not multiples of the kernel.
  CostGrid(grid::Grid<Weight> weights, grid::Grid<grid::Occupancy> classes,
           const MotionModel& motion);
  CostGrid(grid::Grid<Weight> weights, grid::Grid<grid::Occupancy> classes,
           const MotionModel& motion, int kernel, const grid::GridGeometry& original);

  const grid::GridGeometry& geometry() const { return weights_.geometry(); }
  const MotionModel& motion() const { return motion_; }
  // None of them where corners may be cut, since the promise is not made then.
  const KeptDistances& keptDistances() const { return kept_; }
  void setKeptDistances(const KeptDistances& kept) { kept_ = kept; }
  SegmentRule segmentRule() const {
    if (motion_.cut_corners) return SegmentRule::CUT_CORNERS;
    return kept_.any() ? SegmentRule::CENTRE_LATTICE : SegmentRule::CELLS;
  }
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
  Weight minWeight() const { return min_weight_; }
  // The largest; 0 where there is none.
  Weight maxWeight() const { return max_weight_; }
  // Whether all passable cells have the same weight.
  bool uniform() const { return min_weight_ == max_weight_; }

  // The passable cells as bits, computed by the first call and repaired by edits. Several threads
  // may call it at once; the reference is valid as long as this map or a copy of it lives. Throws
  // Stopped; the next call starts again.
  const BitMaps& bitMaps(const base::StopToken& stop) const;

  // The point of a path in a cell, in metres: the middle of the part of the cell that lies in the
  // original map. That is the cell's centre but for the last column and row of a kernel.
  Eigen::Vector2d waypoint(grid::Cell cell) const;

  // Higher in every map that replaces an earlier one; CostmapBuilder gives no two maps the same.
  std::uint64_t revision() const { return revision_; }
  void setRevision(std::uint64_t revision) { revision_ = revision; }

  // With the bit maps, once they are computed, and the counts of weights, from the first edit on.
  std::size_t bytes() const;

  // The cells in which two maps differ; `classes` lies in `weights`.
  struct Change {
    std::vector<grid::CellRect> weights;
    std::vector<grid::CellRect> classes;
  };

  // Changes the map, which equals `before`, in place, in time proportional to `rects` (the first
  // time, to the map). write(weights, classes) writes cells of them only; if it throws, the map must
  // not be used any more. Precondition: nobody else holds the map; `rects` are disjoint.
  template <class Write>
  void edit(const CostGrid& before, const std::vector<grid::CellRect>& rects, Write&& write) {
    write(weights_, classes_);
    finishEdit(before, rects);
  }

  // Makes the map equal to `with`, which differs from it by `change`, in time proportional to that;
  // the revision stays.
  void catchUp(const CostGrid& with, const Change& change);

  // A copy with all that its first edit would compute of the whole map. Throws Stopped.
  std::unique_ptr<CostGrid> copyToEdit(const base::StopToken& stop) const;

 private:
  struct Derived;

  void finishEdit(const CostGrid& before, const std::vector<grid::CellRect>& rects);
  void ownDerived();

  grid::Grid<Weight> weights_;
  grid::Grid<grid::Occupancy> classes_;
  MotionModel motion_;
  KeptDistances kept_;
  int kernel_ = 1;
  grid::GridGeometry original_;
  Weight min_weight_ = 0;
  Weight max_weight_ = 0;
  std::uint64_t revision_ = 0;
  std::shared_ptr<Derived> derived_;  // shared by copies of a map until one is edited
};

// For DoubleBuffered<CostGrid, CostGrid::Change>: catchUp(), and two changes as one.
void copyCells(const CostGrid& from, const CostGrid::Change& change, CostGrid& to);
void addChange(const CostGrid::Change& later, CostGrid::Change& to);

// What changed from costmap to costmap.
using CostChanges = grid::ChangeLog<CostGrid::Change>;

// Whether one step leads from `from` to `to`: neighbours by the motion model, both passable, no
// corner cut unless that is allowed.
bool stepAllowed(const CostGrid& map, grid::Cell from, grid::Cell to);

// Cost of that step, in cells of the original map x weight. Precondition: stepAllowed.
ExactCost stepCost(const CostGrid& map, grid::Cell from, grid::Cell to);

// Cost of a path of steps. Precondition: every step is allowed.
ExactCost costOfSteps(const CostGrid& map, const std::vector<grid::Cell>& cells);

}  // namespace grid_path_planner::costmap
