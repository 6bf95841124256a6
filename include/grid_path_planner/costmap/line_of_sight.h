// Straight lines between two points of a map: whether a vehicle may drive them and what they cost.
//
//   if (lineOfSight(map, from, to)) cost = lineCost(map, from, to);
//
// Legal: the line enters no blocked cell's interior, does not run along an edge between two blocked
// cells, and touches no lattice point whose diagonal pair is blocked; grazing a corner is legal.
// Where corners may be cut, lattice points do not matter. Outside the map is blocked.
//
// Where the map keeps distances (radius > 0) a line is legal exactly if it lies in the centre
// lattice: the closed squares spanned by four neighbouring cell centres that are all passable, the
// closed lines between two neighbouring passable centres, and the passable centres. No point of the
// lattice is nearer to an obstacle than the nearest of its centres, so along every legal line the
// distance is that of centres. Every path of grid steps that cuts no corner lies in it. With a
// kernel the centres are the waypoints of the blocks.
//
// Cost: the line is cut where it crosses the centre lines of the columns (of the rows where it is
// steep); each piece costs its length x the largest weight of the cells whose interior it enters,
// or along an edge the smaller weight of the passable sides. On every path of grid steps this
// equals the step rule. With unit diagonals, which give lines no length, the Euclidean one is used.
//
// Exact: points are given in 1/4096 cell (SegmentPoint), and every decision is one of integers.
//
// Between the centres of cells the same answers are found many times as fast, for searches and
// smoothing, which ask for millions: everything is a sum of integers, without divisions, and where
// all passable cells have one weight only the bit maps are read, a row of the line's cells at a
// time.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>

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

// The point of a path in the cell (CostGrid::waypoint): its centre but for the last column and row
// of a kernel.
SegmentPoint waypointOf(const CostGrid& map, grid::Cell cell);
// A point in the map's frame, in metres.
Eigen::Vector2d worldOf(const CostGrid& map, SegmentPoint point);
// A passable cell that the point lies in or, if it is a lattice point, is a corner of.
// Precondition: there is one.
grid::Cell passableCellAt(const CostGrid& map, SegmentPoint point);

// Whether the line is legal.
bool lineOfSight(const CostGrid& map, SegmentPoint from, SegmentPoint to);
// The same between the centres of two cells. `bits`: of the map. Precondition: both lie in it.
bool lineOfSight(const BitMaps& bits, grid::Cell from, grid::Cell to, SegmentRule rule);

// In cells of the original map x weight. Precondition: lineOfSight, or the map keeps distances; then
// blocked cells, which an end of a path may cross, cost nothing.
double lineCost(const CostGrid& map, SegmentPoint from, SegmentPoint to);

// lineCost(); none where the line is not legal or costs more than `limit`. Fast between centres.
// `bits`: those of the map where it has one weight, else null. Precondition: both lie in the map.
std::optional<double> lineCostWithin(const CostGrid& map, const BitMaps* bits, SegmentPoint from,
                                     SegmentPoint to, double limit);
// The same between the centres of two cells, for any weights.
std::optional<double> lineCostWithin(const CostGrid& map, grid::Cell from, grid::Cell to,
                                     double limit = std::numeric_limits<double>::infinity());

}  // namespace grid_path_planner::costmap
