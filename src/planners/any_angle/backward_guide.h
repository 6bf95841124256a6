// What steps cost from cells to the goal, by an exact search from the goal: the estimate of a search with
// other moves, which with it looks at little more than the surroundings of its path.
//
//   SearchResult steps = guide.search(map, request, stop);   // the least-cost path of steps
//   f = g + share * guide.toGoal(index);
//
// It is A* guided by the bound of the blocks (block_bound.h). Cells that it did not come to lie on no path of
// steps that costs less than the least.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/planners/planner.h"
#include "planners/astar/bucket_search.h"
#include "planners/tables/block_bound.h"

namespace grid_path_planner::planners {

class BackwardGuide {
 public:
  static std::size_t bytesFor(const grid::GridGeometry& geometry);

  // Throw Stopped.
  void prepare(const costmap::CostGrid& map, const base::StopToken& stop);
  void update(const costmap::CostGrid& map, const std::vector<grid::CellRect>& changed,
              const base::StopToken& stop);

  // The cells lead from the start to the first goal. FOUND, UNREACHABLE, TIMEOUT or CANCELLED. Throws
  // TooExpensive. Precondition: `map` is the prepared one, start and goal are passable.
  SearchResult search(const costmap::CostGrid& map, const SearchRequest& request,
                      const base::StopToken& stop);

  // After a search: in cell lengths of the searched map x weight; infinite where the search did not come.
  double toGoal(std::uint32_t index) const { return search_.costFromStart(index); }

 private:
  static constexpr int kBlock = 4;

  BlockBounds blocks_{kBlock};
  BucketSearch search_;
};

}  // namespace grid_path_planner::planners
