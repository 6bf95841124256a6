// Searches between two cells of the full-resolution costmap: over the blocks of a kernel where they
// are open, cell by cell where they are not.
//
// Where the block of an end is blocked though the cell is not, a leg at full resolution leads to
// the middle of the open block that costs least to reach and from which the search can go on (or
// straight to the other end, if that is nearer). Where the kernel closes all paths the search is
// repeated at full resolution, if that is allowed.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planners/planner.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planners/search_options.h"
#include "planners/astar/bucket_search.h"
#include "planning/route.h"

namespace grid_path_planner::planning {

// The costmaps at full resolution and with the kernel, and what changed in each until then.
struct CostmapPair {
  std::shared_ptr<const costmap::CostGrid> full_resolution;
  std::shared_ptr<const costmap::CostGrid> downsampled;
  costmap::CostChanges full_resolution_changes;
  costmap::CostChanges downsampled_changes;
};

class MultiResolutionPlanner {
 public:
  // Throws InputError for an unknown planner or options that cannot be used.
  MultiResolutionPlanner(std::string planner, const planners::SearchOptions& options,
                         planners::PlannerMaker make_planner);

  // Of all searches together; memoryLimitOf() the options until then. Where it does not suffice,
  // find() gives INVALID_REQUEST.
  void limitMemory(std::size_t bytes) { memory_limit_ = bytes; }
  // Memory that they may take on the maps that they are prepared for.
  std::size_t bytes() const;
  // As Planner::releaseOptionalMemory().
  void releaseOptionalMemory();
  // The same once prepare() was called for a costmap of this geometry.
  std::size_t bytesFor(const grid::GridGeometry& downsampled) const;

  // Prepares the planner for the costmaps. Where it is known what changed since those of the last
  // call, the planner is updated instead. Throws Stopped.
  void prepare(const CostmapPair& maps, const base::StopToken& stop);

  // Updates the planner to costmaps that no request needs yet, if prepare() was called and an
  // update is cheap. Throws Stopped.
  void follow(const CostmapPair& maps, const base::StopToken& stop);

  bool isPreparedFor(const CostmapPair& maps) const { return downsampled_ == maps.downsampled; }
  // Whether follow() to these costmaps costs no more than what changed, and that is little.
  bool canFollow(const CostmapPair& maps) const;

  // Returns when the planner's background work is done. Throws Stopped.
  void finishBackgroundWork(const base::StopToken& stop) { planner_->finishBackgroundWork(stop); }

  // Precondition: both cells are passable at full resolution.
  Route find(grid::Cell start, grid::Cell goal, bool retry_finer, bool record_expanded,
             const base::StopToken& stop);

  // The cells at full resolution that find() reaches from `start`: a byte a cell, not 0 where
  // reached.
  std::vector<std::uint8_t> reachable(grid::Cell start, bool retry_finer,
                                      const base::StopToken& stop);

 private:
  // Frees what is optional where so many more are not left.
  void makeRoomFor(std::size_t bytes);
  grid::Cell blockOf(grid::Cell cell) const {
    return {cell.column / downsampled_->kernel(), cell.row / downsampled_->kernel()};
  }
  grid::Cell middleOf(grid::Cell block) const;
  bool blockOpen(grid::Cell cell) const { return downsampled_->passable(blockOf(cell)); }

  // Takes the costmap at full resolution and updates the searches on it where that is cheap.
  void followFullResolution(const CostmapPair& maps, const base::StopToken& stop);

  using Blocks = std::vector<std::uint8_t>;  // a byte a block of downsampled_

  Blocks openBlocks() const;
  // From a cell whose block is blocked to the middle of a block that is `wanted`, or to `other`.
  planners::SearchResult searchOpenBlock(grid::Cell from, grid::Cell other, const Blocks& wanted,
                                         bool record_expanded, const base::StopToken& stop);
  Route findOnKernelOne(grid::Cell start, grid::Cell goal, bool record_expanded,
                        const base::StopToken& stop);
  Route findOverBlocks(grid::Cell start, grid::Cell goal, bool record_expanded,
                       const base::StopToken& stop);
  Route findAtFullResolution(grid::Cell start, grid::Cell goal, bool record_expanded,
                             const base::StopToken& stop);

  planners::PlannerMaker make_planner_;
  std::string planner_name_;
  planners::SearchOptions options_;
  std::size_t memory_limit_;
  std::shared_ptr<const costmap::CostGrid> full_resolution_;
  std::shared_ptr<const costmap::CostGrid> downsampled_;
  std::unique_ptr<planners::Planner> planner_;  // on downsampled_

  // Both on full_resolution_ and made when first needed; the map that each is prepared for.
  std::unique_ptr<planners::Planner> finer_planner_;
  std::shared_ptr<const costmap::CostGrid> finer_map_;
  std::unique_ptr<planners::BucketSearch> open_block_search_;
  std::shared_ptr<const costmap::CostGrid> open_block_map_;
};

}  // namespace grid_path_planner::planning
