// Jump point search over cells of any weight, and A* where that is faster.
//
// Guaranteed: the cost is the least there is, on every map and motion model, unless the options ask
// A* for less.
//
// Where diagonals are sqrt 2 long and cut no corners, the search with jumps
// (planners/jump_point/weighted_jump_search.h) prunes symmetric paths: nearly all cells of
// plateaus, many of the slopes around obstacles, few where every cell has another weight. Whether
// jumping pays is estimated when a map is prepared and updated
// (planners/jump_point/pruning_estimate.h). Where it does not, and for other motion models, A*
// answers, with the heuristic that fits the motion model. The jumps are prepared by tiles, when a
// search first comes to them or by finishBackgroundWork(); until then A* answers searches that come
// to many new ones, at the same cost: the first to more than 1/32 of the map, the next to 1/16, and
// so on; of maps above 2^26 cells to any. No map is refused: where a path costs more than the keys of the jumps hold, A* answers too. No option is ignored: with a search option
// (heuristic, scale, epsilon, tie-break) that is not the default, A* answers with it.
#pragma once

#include <memory>
#include <vector>

#include "grid_path_planner/planners/a_star_options.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/astar/a_star.h"
#include "planners/jump_point/pruning_estimate.h"
#include "planners/jump_point/weighted_jump_search.h"

namespace grid_path_planner::planners {

class WeightedJumpPoint : public Planner {
 public:
  static PlannerTraits declaredTraits();

  // Throws InputError for options that cannot be used.
  explicit WeightedJumpPoint(const AStarOptions& options = {});

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;
  bool optimalFor(const costmap::CostGrid& map) const override;
  BackgroundWork backgroundWork() override;
  void finishBackgroundWork(const base::StopToken& stop) override;

 private:
  std::string lessMemoryAdvice() const override;
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const std::vector<grid::CellRect>& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

  bool shouldJump() const;
  std::uint64_t mostTiles() const;
  void prepareAStar(const base::StopToken& stop);
  AStarOptions optionsOfAStar(const costmap::MotionModel& motion) const;

  AStarOptions options_;
  bool a_star_asked_for_;
  PruningEstimate pruning_;
  bool jumps_ready_ = false;
  int too_many_tiles_ = 0;  // how often a search came to too many since the map was prepared
  WeightedJumpSearch jumps_;
  std::unique_ptr<AStar> a_star_;  // null until it is prepared
};

}  // namespace grid_path_planner::planners
