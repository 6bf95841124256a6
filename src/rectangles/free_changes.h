// Which cells of a map became free or blocked since its rectangles were made.
#pragma once

#include <vector>

#include "grid_path_planner/terrain/bit_maps.h"

namespace grid_path_planner {

struct FreeChanges {
  std::vector<CellRect> gained;  // free now, in no rectangle: disjoint
  std::vector<CellRect> lost;    // blocked now, in a rectangle: disjoint

  bool empty() const { return gained.empty() && lost.empty(); }
};

// Of the cells of `changed`, which lies in the map. `rectangles`: all that hold cells of it. Throws
// Stopped.
FreeChanges freeChanges(const BitMap& free, const std::vector<CellRect>& rectangles,
                        const CellRect& changed, const StopToken& stop);

}  // namespace grid_path_planner
