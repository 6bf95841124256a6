// A* over the cells of a grid (Hart, Nilsson & Raphael 1968), weighted A* for epsilon > 1 (Pohl
// 1970).
//
// Guaranteed: with an admissible heuristic, epsilon 1 and no published tie-break the cost is the
// least there is, without tolerance; `optimalFor` says whether that is so on a map. With epsilon >
// 1 and an admissible heuristic it is at most epsilon times the least. Otherwise nothing but a
// legal path.
//
// `a_star_published` is the original study's program: it stops when the goal is generated, not when
// it is expanded, and claims nothing. It exists so that the study can be repeated.
#pragma once

#include "grid_path_planner/search/best_first_search.h"
#include "grid_path_planner/search/planner.h"
#include "grid_path_planner/search/search_options.h"

namespace grid_path_planner {

class AStar : public Planner {
 public:
  // Throws InputError for options that cannot be used.
  explicit AStar(const SearchOptions& options = {});
  static AStar published(const SearchOptions& options = {});

  std::size_t bytesFor(const GridGeometry& geometry) const override;
  bool optimalFor(const CostGrid& map) const override;

 protected:
  void doPrepare(const StopToken& stop) override;
  void doUpdate(const CellRect& changed, const StopToken& stop) override;
  PlanResult doPlan(const PlanRequest& request, const StopToken& stop) override;

 private:
  AStar(Traits traits, const SearchOptions& options, BestFirstSearch::GoalTest goal_test);

  SearchOptions options_;
  BestFirstSearch::GoalTest goal_test_;
  BestFirstSearch search_;
};

}  // namespace grid_path_planner
