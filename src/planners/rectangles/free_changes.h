// The cells of a map that became free or blocked since its rectangles were cut.
#pragma once

#include <vector>

#include "grid_path_planner/costmap/bit_maps.h"

namespace grid_path_planner::planners {

struct FreeChanges {
  std::vector<grid::CellRect> gained;  // free now, in no rectangle: disjoint
  std::vector<grid::CellRect> lost;    // blocked now, in a rectangle: disjoint

  // Around all of them.
  grid::CellRect hull() const;
};

// Of the cells of `changed`, which lies in the map. `rectangles`: all that overlap `changed`. Throws
// Stopped.
FreeChanges freeChanges(const costmap::BitMap& free, const std::vector<grid::CellRect>& rectangles,
                        const grid::CellRect& changed, const base::StopToken& stop);

// The same in groups that can be applied one after the other: each of one rectangle, or of several
// whose hull is at most some dozens of cells wide.
std::vector<FreeChanges> groupedByPlace(const FreeChanges& changes);

}  // namespace grid_path_planner::planners
