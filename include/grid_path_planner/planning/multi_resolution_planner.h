// Between two cells of the full map, over the blocks of a kernel where they are open and cell by
// cell where they are not.
//
// Where the block of an end is blocked though the cell is not, a leg at full resolution leads to
// the middle of the open block that is cheapest to reach and leads on (or straight to the other
// end, if that is nearer). Where the kernel closes the way the search is repeated at full
// resolution, if that is allowed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planners/bucket_search.h"
#include "grid_path_planner/planners/planner.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planners/search_options.h"

namespace grid_path_planner::planning {

// Cells that follow each other on one map, or turning points as in SearchResult.
struct Leg {
  std::shared_ptr<const costmap::CostGrid> map;
  std::vector<grid::Cell> cells;
  std::vector<costmap::SegmentPoint> points;
};

struct Route {
  base::Status status = base::Status::UNREACHABLE;
  std::string message;
  std::vector<Leg> legs;  // a leg's last cell and the next one's first are the same place or block
  costmap::ExactCost cost;  // as in SearchResult
  double segment_cost = 0.0;
  bool optimal = false;  // the planner promises that none of its kind (over the
                         // grid, or at any angle) costs less on the map searched
  bool taut = false;     // of any angle, and none is shorter: smoothing has nothing left to do
  int kernel = 1;        // of the map that the longest part was searched on
  base::Statistics statistics;
  std::vector<Eigen::Vector2d> expanded;  // centres, metres
};

// The maps at full resolution and with the kernel, and the cells in which each differs from that of
// the revision before.
struct CostmapPair {
  std::shared_ptr<const costmap::CostGrid> full_resolution;
  std::shared_ptr<const costmap::CostGrid> downsampled;
  grid::CellRect full_resolution_change;
  grid::CellRect downsampled_change;
};

class MultiResolutionPlanner {
 public:
  // Throws InputError for an unknown planner or options that cannot be used.
  MultiResolutionPlanner(std::string planner, const planners::SearchOptions& options,
                         planners::PlannerMaker make_planner);

  // Takes the maps. Where they follow those of the last call by one revision, what was made of
  // those is repaired. Throws Stopped.
  void prepare(const CostmapPair& maps, const base::StopToken& stop);

  // Keeps up with maps that nothing is asked about yet, if prepare() was called and that is cheap:
  // so the planner misses no revision. Throws Stopped.
  void follow(const CostmapPair& maps, const base::StopToken& stop);

  // Returns when the planner has made what it makes in the background. Throws Stopped.
  void finishBackgroundWork(const base::StopToken& stop) { planner_->finishBackgroundWork(stop); }

  // Precondition: both cells are passable on the fine map.
  Route find(grid::Cell start, grid::Cell goal, bool retry_finer, bool record_expanded,
             const base::StopToken& stop);

  // The cells of the fine map that find() reaches from `start`: a byte a cell, not 0 where reached.
  std::vector<std::uint8_t> reachable(grid::Cell start, bool retry_finer,
                                      const base::StopToken& stop);

 private:
  grid::Cell blockOf(grid::Cell cell) const {
    return {cell.column / searched_->kernel(), cell.row / searched_->kernel()};
  }
  grid::Cell middleOf(grid::Cell block) const;
  bool blockOpen(grid::Cell cell) const { return searched_->passable(blockOf(cell)); }

  // Brings what was made of the last fine map up to date.
  void followFine(const CostmapPair& maps, const base::StopToken& stop);

  using Blocks = std::vector<std::uint8_t>;  // a byte a block of searched_

  Blocks openBlocks() const;
  // From a cell whose block is blocked to the middle of a block that is `wanted`, or to `other`.
  planners::SearchResult leave(grid::Cell from, grid::Cell other, const Blocks& wanted,
                               bool record_expanded, const base::StopToken& stop);
  Route findOverBlocks(grid::Cell start, grid::Cell goal, bool record_expanded,
                       const base::StopToken& stop);
  Route findFine(grid::Cell start, grid::Cell goal, bool record_expanded,
                 const base::StopToken& stop);

  planners::PlannerMaker make_planner_;
  std::string planner_name_;
  planners::SearchOptions options_;
  std::shared_ptr<const costmap::CostGrid> fine_;
  std::shared_ptr<const costmap::CostGrid> searched_;
  std::unique_ptr<planners::Planner> planner_;           // on searched_
  std::unique_ptr<planners::Planner> finer_;             // on fine_, made when first needed
  std::shared_ptr<const costmap::CostGrid> finer_map_;   // what finer_ is prepared for
  std::unique_ptr<planners::BucketSearch> leaver_;       // on fine_, made when first needed
  std::shared_ptr<const costmap::CostGrid> leaver_map_;  // what leaver_ is prepared for
};

}  // namespace grid_path_planner::planning
