// Free space cut into rectangles.
//
//   std::vector<CellRect> rectangles = largestFirst(map.bitMaps(stop), {}, stop);
//
// largestFirst is the R-map of Ahn & Jeon (2010) and Park (2013): repeatedly the largest empty
// rectangle of what is left, until nothing is left. Of equally large ones the first column is the
// smallest, then the last row the smallest, then the width the greatest, as the published code
// breaks ties.
//
// Guaranteed: the rectangles are disjoint, their union is the free space (all of it, unless a limit
// ends the work before), each is the largest of what the ones before it left, and the same free
// space gives the same rectangles in the same order.
//
// How: the published code scans the whole map for every rectangle. Here each maximal run of free
// cells of each row is an entry of a heap, ordered by the largest rectangle that has its last row
// in that run. Free space only shrinks, so the area of an entry is an upper bound: the rectangle of
// the entry on top is used if it is still free; otherwise the runs that are left are measured
// again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/bit_maps.h"
#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::planners {

struct DecompositionLimits {
  std::size_t count = std::numeric_limits<std::size_t>::max();  // no more rectangles than these
  std::int64_t smallest_area = 1;                               // none of fewer cells
  std::size_t bytes = std::numeric_limits<std::size_t>::max();  // all memory at any time
};

// Thrown before more memory than DecompositionLimits::bytes is allocated.
struct DecompositionTooLarge {};

// `free`: a cell's bit is 1 where it is free. Throws Stopped and DecompositionTooLarge.
std::vector<grid::CellRect> largestFirst(const costmap::BitMaps& free,
                                         const DecompositionLimits& limits,
                                         const base::StopToken& stop);

// The number of maximal runs of free cells in all rows.
std::size_t countRuns(const costmap::BitMap& free);

// About the memory of largestFirst, its result included, for a map with so many runs in its rows; a
// map without obstacles has one a row. Where large rectangles cross many runs it may be several
// times as much: DecompositionLimits::bytes sets a bound.
std::size_t largestFirstBytes(const grid::GridGeometry& geometry, std::size_t runs);

// A partition where order does not matter, in one pass: each row's maximal runs, joined with the
// run above where both have the same columns. Rectangles by first row, then first column. Throws
// Stopped.
std::vector<grid::CellRect> mergedRuns(const costmap::BitMap& free, const base::StopToken& stop);

}  // namespace grid_path_planner::planners
