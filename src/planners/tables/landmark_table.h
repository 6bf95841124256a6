// Costs from a few cells, the landmarks, to every cell: by the triangle inequality
// |cost(landmark, a) - cost(landmark, b)| bounds the cost between a and b from below (Goldberg &
// Harrelson, "Computing the shortest path: A* search meets graph theory", SODA 2005; differential
// heuristics, Sturtevant et al., IJCAI 2009).
//
//   const LandmarkTable table(map, 16, stop);
//   const CostDecreases decreases;  // since the table was made: none
//   const LandmarkBound bound(table, decreases, goal_index);
//   SearchKey least = bound(index);  // from that cell to the goal
//
// The costs are kept in 32 bits a landmark (compact_cost.h), those of one cell side by side: 16
// landmarks are a cache line. Where a cost does not fit, half as many are kept in 64 bits. The bounds are exact
// differences, and consistent: of paths of equal cost a search expands only one.
//
// Landmarks are chosen where the bounds of those before are worst ("avoid", Goldberg & Werneck
// 2005), as leaves of the shortest-path tree of a cell drawn by a fixed seed: the same map
// gives the same table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/zeroed_array.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/keys.h"
#include "planners/tables/compact_cost.h"

namespace grid_path_planner::planners {

class CostDecreases;
class LandmarkBound;

class LandmarkTable {
 public:
  using Decreases = CostDecreases;
  using Bound = LandmarkBound;
  static constexpr int kLanes = 4;  // the 32-bit entries of a row are a multiple of it

  // Bytes of a table; of one while it is made.
  static std::size_t bytesFor(const grid::GridGeometry& geometry, int landmarks);
  static std::size_t makingBytesFor(const grid::GridGeometry& geometry, int landmarks);

  // Throws Stopped. Where a cost does not fit into 64 bits, its diagonal part being above 8.0e6, there are no
  // landmarks, no memory, and every bound is 0.
  LandmarkTable(const costmap::CostGrid& map, int landmarks, const base::StopToken& stop);

  // Whether entries have 64 bits.
  bool wide() const { return wide_; }
  // Entries of a cell, one a landmark, the rest 0: kNoCompactCost, or kNoWideCost, where the cell is unreachable.
  // Precondition: those of wideRow(): wide(), of row(): not so.
  const CompactCost* row(std::uint32_t index) const {
    return reinterpret_cast<const CompactCost*>(rows_ + index * row_bytes_);
  }
  const WideCost* wideRow(std::uint32_t index) const {
    return reinterpret_cast<const WideCost*>(rows_ + index * row_bytes_);
  }
  // How many a row has.
  int stride() const {
    return static_cast<int>(row_bytes_ / (wide_ ? sizeof(WideCost) : sizeof(CompactCost)));
  }
  // One of them, kNoWideCost where the cell is unreachable.
  WideCost entry(std::uint32_t index, int landmark) const;
  // A key of `scale` that is certain where entries differ by this much.
  SearchKey keyOf(WideCost difference, const KeyScale& scale) const;
  const std::vector<grid::Cell>& landmarks() const { return landmarks_; }
  std::size_t bytes() const { return memory_.size(); }

 private:
  class Making;

  std::size_t row_bytes_;
  bool wide_ = false;
  base::ZeroedArray<unsigned char> memory_;
  unsigned char* rows_;  // in memory_, where a cache line begins
  std::vector<grid::Cell> landmarks_;
};

// The places of the map where costs decreased since the table was made; they weaken its bounds.
//
// A path that passes none of these places costs at least the table's bound. Any other path arrives
// at the neighbourhood of a place by unchanged steps, and leaves that of a place by unchanged steps:
// it costs at least the path to the nearest place plus the path from the nearest place to the goal.
// A place is stored as the interval of its cells' entries, so it takes no more time than a
// landmark's row.
class CostDecreases {
 public:
  // Weights of cells of `rect` decreased, or cells became passable. Precondition: `rect` lies in the map.
  void add(const LandmarkTable& table, const grid::GridGeometry& geometry,
           const grid::CellRect& rect);

  bool empty() const { return places_.empty(); }
  bool usable() const { return true; }
  // Around all of them.
  grid::CellRect hull() const;
  // A lower bound of the cost from a cell to the nearest place. Precondition: not empty.
  SearchKey least(const LandmarkTable& table, std::uint32_t index, const KeyScale& scale) const;

 private:
  struct Place {
    grid::CellRect rect;
    std::vector<WideCost> low;   // smallest entry of the rectangle's cells, a landmark
    std::vector<WideCost> high;  // largest; below `low` where the landmark reaches none of them

    void join(const Place& other);
  };

  static Place placeOf(const LandmarkTable& table, const grid::GridGeometry& geometry,
                       const grid::CellRect& rect);

  std::vector<Place> places_;
};

// The bound to one goal, as keys of a scale.
class LandmarkBound {
 public:
  // `table` and `decreases` outlive the bound.
  LandmarkBound(const LandmarkTable& table, const CostDecreases& decreases, std::uint32_t goal,
                const KeyScale& scale = kWideScale);

  SearchKey operator()(std::uint32_t index) const;
  // Whether a landmark is known to reach one of both and not the other: no path leads from that cell to the goal.
  bool separates(std::uint32_t index) const;

 private:
  const LandmarkTable& table_;
  const CostDecreases& decreases_;
  KeyScale scale_;
  std::uint32_t goal_;
  std::vector<CompactCost> goal_row_;  // one of both
  std::vector<WideCost> wide_goal_row_;
  SearchKey goal_to_decreases_ = 0;
};

}  // namespace grid_path_planner::planners
