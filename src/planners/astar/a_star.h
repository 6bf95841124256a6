// A* over the cells of a grid (Hart, Nilsson & Raphael 1968), weighted A* for epsilon > 1 (Pohl
// 1970).
//
// Guaranteed: with an admissible heuristic and epsilon 1 the cost is the least there is, without
// tolerance; optimalFor() says whether that is so on a map. With epsilon > 1 and an admissible
// heuristic it is at most epsilon times the least. Otherwise nothing but a legal path.
//
// With tie_break none the order of cells with nearly equal f-values is that of the fastest open
// list (bucket_search.h). The others order strictly by f-value, then by what they are named for
// (best_first_search.h), at several times the cost.
#pragma once

#include <optional>
#include <vector>

#include "grid_path_planner/planners/a_star_options.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/astar/best_first_search.h"
#include "planners/astar/bound_choice.h"
#include "planners/astar/bucket_search.h"
#include "planners/tables/block_bound.h"
#include "planners/tables/precomputed_heuristic.h"

namespace grid_path_planner::planners {

class AStar : public Planner {
 public:
  static PlannerTraits declaredTraits();

  // Throws InputError for options that cannot be used.
  explicit AStar(const AStarOptions& options = {});
  // With heuristic blocks: they are used where `choice` says so, and the closed form of the motion model
  // elsewhere. The choice must live as long as the planner, and be that of its map. Precondition:
  // tie_break none.
  AStar(const AStarOptions& options, BoundChoice& choice);

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;
  bool optimalFor(const costmap::CostGrid& map) const override;

  // For another search over the same map: where the options ask for landmarks and these are there.
  // Valid until the next call of another method.
  std::optional<LandmarkBound> landmarkBound(grid::Cell goal, const KeyScale& scale) {
    return tables_.landmarkBound(map().geometry().index(goal).value(), scale);
  }

 private:
  std::string lessMemoryAdvice() const override;
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const std::vector<grid::CellRect>& changed, const base::StopToken& stop) override;
  BackgroundWork doBackgroundWork() override { return tables_.work(); }
  void doFinishBackgroundWork(const base::StopToken& stop) override { tables_.wait(stop); }
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;
  SearchResult planByBuckets(const SearchRequest& request, const base::StopToken& stop);
  bool blocksAlone() const;
  bool learns() const;
  bool useBlocks() const;
  BlockBound& boundTo(grid::Cell goal, const base::StopToken& stop);
  void weighLastSearch(const base::StopToken& stop);
  double shareSpared(const BlockEstimate& blocks) const;
  template <class Search>
  SearchResult withBound(grid::Cell goal, const base::StopToken& stop, const Search& search);
  SearchResult planWithBlocks(const SearchRequest& request, const base::StopToken& stop);
  SearchResult planWithBound(const SearchRequest& request, const base::StopToken& stop);
  SearchResult planInOrder(const SearchRequest& request, const base::StopToken& stop);

  AStarOptions options_;
  bool strictly_ordered_;
  BucketSearch by_buckets_;  // one of the two is used
  BestFirstSearch in_order_;
  // Of blocks that are smaller than those of jumps, since an expansion of A* gains more by a larger
  // bound.
  static constexpr int kBlock = 4;
  BlockBounds blocks_{kBlock};
  bool blocks_ready_ = false;

  BoundChoice* choice_ = nullptr;
  // By the octile distance, while the choice is undecided; its g-values are still there.
  struct LastSearch {
    grid::Cell start, goal;
    double cost = 0.0;
    std::size_t expanded = 0;  // 0: there is none
  };
  LastSearch last_;
  PrecomputedHeuristic tables_;
};

}  // namespace grid_path_planner::planners
