// Segments between the centres of two cells: the same answers as costmap/line_of_sight.h, many times as
// fast, for searches and smoothers that ask for millions.
//
// The general ones divide at every column; between centres everything is a sum of integers, and
// where all passable cells weigh the same only sight matters, which is looked for on the bit maps,
// a row of the segment's cells at a time.
#pragma once

#include <limits>
#include <optional>

#include "grid_path_planner/costmap/bit_maps.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/line_of_sight.h"

namespace grid_path_planner::costmap {

// lineCost() between the centres; none where the segment is not legal or costs more than
// `limit`, of which it is then not walked to the end. Precondition: both cells lie in the map.
std::optional<double> centreSegmentCost(const CostGrid& map, grid::Cell from, grid::Cell to,
                                        double limit = std::numeric_limits<double>::infinity());

// lineOfSight() between the centres, on a map with these bits. Precondition: as above.
bool centresInSight(const BitMaps& bits, grid::Cell from, grid::Cell to, bool cut_corners);

// lineCost() between any two points, the fast way where both are centres; none where the segment
// is not legal or costs more than `limit`. `bits`: those of the map where it has one weight, or
// null. Precondition: both lie in the map.
std::optional<double> lineCost(const CostGrid& map, const BitMaps* bits, SegmentPoint from,
                               SegmentPoint to, double limit);

}  // namespace grid_path_planner::costmap
