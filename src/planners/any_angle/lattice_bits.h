// The centre lattice of a map (costmap/line_of_sight.h) as bits, for LatticeSearch.
//
// Its points are the centres of the passable cells, by the cells' columns and rows. `squares`: bit
// (column, row) is 1 where the square spanned by this point and its neighbours to the right, above
// and beyond both lies in the lattice. `portals`: the points at which a path can go on where no
// interval does: the ends of thin edges, which have no square on either side, and the points at
// which two squares meet in a corner only.
#pragma once

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/bit_maps.h"

namespace grid_path_planner::planners {

struct LatticeBits {
  costmap::BitMap squares;
  costmap::BitMap portals;

  LatticeBits() = default;
  // Throws Stopped.
  LatticeBits(const costmap::BitMap& passable, const base::StopToken& stop);

  // `passable` differs from before only inside `changed`. Throws Stopped, and must be called again
  // then.
  void update(const costmap::BitMap& passable, const grid::CellRect& changed,
              const base::StopToken& stop);

  std::size_t bytes() const { return squares.bytes() + portals.bytes(); }
};

}  // namespace grid_path_planner::planners
