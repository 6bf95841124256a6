// Which cells of a map became free or blocked since its rectangles were made.
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

// Of the cells of `changed`, which lies in the map. `rectangles`: all that hold cells of it. Throws
// Stopped.
FreeChanges freeChanges(const costmap::BitMap& free, const std::vector<grid::CellRect>& rectangles,
                        const grid::CellRect& changed, const base::StopToken& stop);

// The same in groups that may be dealt with one after the other: of one rectangle, or of several
// that lie within some dozens of cells.
std::vector<FreeChanges> nearEachOther(const FreeChanges& changes);

}  // namespace grid_path_planner::planners
