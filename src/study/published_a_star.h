// The original study's programs, so that it can be repeated: A* that stops when the goal is
// generated, not when it is expanded, and A* that adds to its estimate a thousandth of the cross
// product for every cell off the straight line. Neither guarantees a least cost.
#pragma once

#include "planners/astar/a_star.h"

namespace grid_path_planner::study {

class PublishedAStar : public planners::AStar {
 public:
  static constexpr const char* kName = "a_star_published";

  // `a_star_published`. Both throw InputError for options that cannot be used.
  PublishedAStar(const planners::AStarOptions& options, bool published_cross)
      : planners::AStar(
            kName, options,
            {planners::BestFirstSearch::GoalTest::WHEN_GENERATED, shareOf(published_cross)}) {}

  // `a_star` with tie_break cross_product_published.
  explicit PublishedAStar(const planners::AStarOptions& options)
      : planners::AStar("a_star", options,
                        {planners::BestFirstSearch::GoalTest::WHEN_EXPANDED, shareOf(true)}) {}

 private:
  static long double shareOf(bool published_cross) { return published_cross ? 0.001L : 0.0L; }
};

}  // namespace grid_path_planner::study
