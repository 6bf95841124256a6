// The bits of the cells beside 64 cells of a row of a costmap::BitMap.
#pragma once

#include "grid_path_planner/costmap/bit_maps.h"

namespace grid_path_planner::planners {

// Bit i of the result is the bit of the cell before (after) cell i of the line.
inline costmap::BitMap::Word before(const costmap::BitMap::Word* at) {
  return *at << 1 | at[-1] >> 63;
}
inline costmap::BitMap::Word after(const costmap::BitMap::Word* at) {
  return *at >> 1 | at[1] << 63;
}

}  // namespace grid_path_planner::planners
