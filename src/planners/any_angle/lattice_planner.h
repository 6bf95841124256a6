// What Anya and Polyanya do on maps that keep distances: LatticeSearch with its bits.
#pragma once

#include <memory>

#include "grid_path_planner/planners/planner.h"
#include "planners/any_angle/lattice_search.h"

namespace grid_path_planner::planners {

class LatticePlanner {
 public:
  // Of the map's centre lattice. Throws Stopped.
  LatticePlanner(const costmap::CostGrid& map, const base::StopToken& stop);

  // The map differs from the one before only inside `changed`. Throws Stopped, and must be called
  // again then.
  void update(const costmap::CostGrid& map, const grid::CellRect& changed,
              const base::StopToken& stop);

  // Precondition: `map` is that of the last call; start and goal are passable and differ.
  SearchResult search(const costmap::CostGrid& map, const SearchRequest& request,
                      const base::StopToken& stop);

  // Of the bits.
  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return 2 * costmap::BitMap::bytesFor(geometry.width(), geometry.height());
  }

 private:
  LatticeBits bits_;
  LatticeSearch search_;
};

// Null for maps that keep no distances.
std::unique_ptr<LatticePlanner> latticePlannerFor(const costmap::CostGrid& map,
                                                  const base::StopToken& stop);

}  // namespace grid_path_planner::planners
