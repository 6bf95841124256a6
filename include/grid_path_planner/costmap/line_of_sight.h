// Straight segments between any two points: whether a vehicle may drive them and what they cost.
//
// Legal: the segment meets no blocked cell's interior, does not run along an edge between two
// blocked cells, and touches no lattice point whose diagonal pair is blocked; grazing a corner is
// legal. Where corners may be cut, lattice points are not looked at. Outside the map is blocked.
//
// Cost: the segment is cut at the lines through cell centres across its major axis; each piece
// costs its length x the largest weight whose interior it meets, or along an edge the cheaper
// passable side. On every path of grid steps this equals the step rule. With unit diagonals there
// is no length to measure by and the Euclidean one is used.
//
// Exact: points are given in 1/4096 cell (`SegmentPoint`), and every decision is one of integers.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::costmap {

struct SegmentPoint {
  static constexpr std::int64_t kUnitsPerCell = 4096;
  std::int64_t x = 0;
  std::int64_t y = 0;

  static SegmentPoint centreOf(grid::Cell cell) {
    return {cell.column * kUnitsPerCell + kUnitsPerCell / 2,
            cell.row * kUnitsPerCell + kUnitsPerCell / 2};
  }
  // The nearest one to a point in cell units. Precondition: |coordinate| < 2^20.
  static SegmentPoint nearest(const Eigen::Vector2d& cells);

  friend bool operator==(SegmentPoint a, SegmentPoint b) { return a.x == b.x && a.y == b.y; }
  friend bool operator!=(SegmentPoint a, SegmentPoint b) { return !(a == b); }
};

// Where a path passes through the cell (CostGrid::waypoint): its centre but for the last column and
// row of a kernel.
SegmentPoint waypointOf(const CostGrid& map, grid::Cell cell);
// The same place as a point of the map's plane, in metres.
Eigen::Vector2d worldOf(const CostGrid& map, SegmentPoint point);
// A passable cell that the point lies in or, a lattice point, is a corner of. Precondition: there
// is one.
grid::Cell passableCellAt(const CostGrid& map, SegmentPoint point);

bool lineOfSight(const CostGrid& map, SegmentPoint from, SegmentPoint to);

// In cells of the original map x weight. Precondition: lineOfSight.
double lineCost(const CostGrid& map, SegmentPoint from, SegmentPoint to);

}  // namespace grid_path_planner::costmap
