// The cells that a polygon touches.
//
//   for (const RowSpan& span : touchedCells(corners, map.geometry().rect()))
//     std::fill(map.row(span.row) + span.first, map.row(span.row) + span.end, 100);
//
// Guaranteed: a cell is named if and only if its interior and the polygon's share more than a strip of 1e-9
// cells. grid/formats/drawn_shapes.h goes by the centres of the cells instead, and may leave out a corner of an
// obstacle; here none is left out.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::grid {

// The cells of a row with column in [first, end).
struct RowSpan {
  int row;
  int first;
  int end;
};

// Those in `within`, disjoint, by rows and then by columns. `corners`: in cells, as
// GridGeometry::gridFromWorld() gives them; three at least, all finite. Inside is where a ray crosses an odd
// number of edges. Takes time in proportion to the rows that the edges cross and to the spans.
std::vector<RowSpan> touchedCells(const std::vector<Eigen::Vector2d>& corners,
                                  const CellRect& within);

}  // namespace grid_path_planner::grid
