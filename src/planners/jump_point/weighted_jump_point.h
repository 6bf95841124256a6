// Jump point search over cells of any weight, and A* where that is faster.
//
// Guaranteed: the cost is the least there is, on every map and motion model, unless the options ask
// A* for less.
//
// Where diagonals are sqrt 2 long and cut no corners, the search with jumps
// (planners/jump_point/weighted_jump_search.h) prunes symmetric paths: nearly all cells of
// plateaus, many of the slopes around obstacles, few where every cell has another weight. Whether
// jumping pays is estimated on maps of several weights (planners/jump_point/pruning_estimate.h). Where
// it does not, and for other motion models, A* answers, with the heuristic that fits the motion model or,
// where weights differ and it pays, the bound of the blocks (planners/tables/block_bound.h). Jumps use
// that bound from their first expansions on where it pays, else in long searches only. A sample of the map
// and the first searches tell, for each of both, where it does (planners/astar/bound_choice.h).
//
// The jumps are prepared by tiles, when a search first comes to them or by finishBackgroundWork().
// Until then a substitute answers at the same cost, so that a first plan waits for no preparation: A*,
// where a search comes to more new tiles than were paid for. One is for so many expansions of A* that
// making it adds some per cent to their time, more once they are many; before the first one nothing is
// estimated either. Small maps are paid for, and what an update undid where that is little; of maps
// above 2^26 cells nothing is.
//
// A goal that is asked for again after a change of the map is that of a vehicle which drives:
// finishBackgroundWork() makes its tree then, on maps of several weights, and the tree answers after
// small changes, where that takes less than a search (planners/replanning/kept_search_tree.h). Which of several
// least-cost paths it finds depends on the calls before, as that of incremental_a_star does, which
// `answered_by` names then.
//
// Searches that have taken as long as tables of landmarks take are followed by such tables, on maps of several
// weights where jumps pay: finishBackgroundWork() has them made, and they bound the jumps from then on
// (planners/jump_point/paid_landmarks.h). They and the tree take memory that others do not need, and give it back.
//
// On maps of one weight JumpPoint answers, whose bits are made in the time in which A* is prepared, and
// on random noise A*. There finishBackgroundWork() prepares the jumps where they are faster, once they
// are there; elsewhere nothing more is prepared, and searches stay as they are
// (planners/jump_point/jump_point_density.h).
//
// No map is refused: where a path costs more than the keys of the jumps hold, the substitute answers. No
// option is ignored: with a search option (heuristic, scale, epsilon, tie-break) that is not the
// default, A* answers with it. Heuristic landmark alone bounds the jumps, too, where weights differ,
// jumps pay and memory holds both: the tables are A*'s, which answers until they and the jumps are there.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "grid_path_planner/planners/a_star_options.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/astar/a_star.h"
#include "planners/astar/bound_choice.h"
#include "planners/jump_point/jump_point_density.h"
#include "planners/jump_point/paid_landmarks.h"
#include "planners/jump_point/pruning_estimate.h"
#include "planners/jump_point/tile_budget.h"
#include "planners/jump_point/weighted_jump_search.h"
#include "planners/replanning/kept_search_tree.h"

namespace grid_path_planner::planners {

class WeightedJumpPoint : public Planner {
 public:
  static PlannerTraits declaredTraits();

  // Throws InputError for options that cannot be used.
  explicit WeightedJumpPoint(const AStarOptions& options = {});

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;
  bool optimalFor(const costmap::CostGrid& map) const override;
  // The tree of a goal and paid landmarks.
  void releaseOptionalMemory() override;

 private:
  std::string lessMemoryAdvice() const override;
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const std::vector<grid::CellRect>& changed, const base::StopToken& stop) override;
  BackgroundWork doBackgroundWork() override;
  void doFinishBackgroundWork(const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

  SearchResult searchAnew(const SearchRequest& request, const base::StopToken& stop);
  std::optional<SearchResult> searchWithJumps(const SearchRequest& request,
                                              const base::StopToken& stop);

  void learnFromJumps(const base::StopToken& stop);
  void updateJumps(const std::vector<grid::CellRect>& changed, const base::StopToken& stop);
  void catchUp(const base::StopToken& stop);
  bool mayJump() const;
  bool estimatesLater() const;
  void sampleLate(const base::StopToken& stop);
  bool shouldJump() const;
  int blockOfBound() const;
  std::size_t bytesOfAStar(const grid::GridGeometry& geometry) const;
  std::size_t bytesOfBoth() const;
  bool isSmall() const;
  std::size_t bytesOfSearches(const grid::GridGeometry& geometry) const;
  std::size_t bytesBesideSearches(const grid::GridGeometry& geometry) const;
  std::size_t roomForLandmarks() const;
  bool treeFits() const;
  bool treeWanted() const;
  std::uint64_t mostTiles() const;
  void estimate(const std::vector<grid::CellRect>& changed, const base::StopToken& stop);
  void prepareJumps(const base::StopToken& stop);
  void prepareSubstitute(const base::StopToken& stop);
  std::optional<LandmarkBound> landmarksTo(grid::Cell goal);
  std::size_t bytesOfTables();
  void updateSubstitute(const std::vector<grid::CellRect>& changed, const base::StopToken& stop);
  bool jumpPointSubstitutes() const;
  AStarOptions optionsOfAStar(const costmap::CostGrid& map) const;

  AStarOptions options_;
  bool a_star_asked_for_;
  bool landmarks_asked_for_;  // and nothing else
  BoundChoice bound_of_a_star_{kPricesOfAStar};
  BoundChoice bound_of_jumps_{kPricesOfJumps};
  PruningEstimate pruning_;   // of maps of several weights
  JumpPointDensity density_;  // of maps of one
  bool sampled_ = false;      // pruning_ is of the map
  bool counted_ = false;      // density_ is
  bool jumps_ready_ = false;
  TileBudget tiles_;  // of jumps_
  WeightedJumpSearch jumps_;
  std::vector<grid::CellRect> behind_;   // changes that jumps_ has not followed yet
  std::unique_ptr<Planner> substitute_;  // A* or JumpPoint; null until it is prepared
  bool substitute_jumps_ = false;        // it is JumpPoint
  KeptSearchTree tree_;
  PaidLandmarks landmarks_;  // for the jumps
};

}  // namespace grid_path_planner::planners
