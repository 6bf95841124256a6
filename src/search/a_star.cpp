#include "grid_path_planner/search/a_star.h"

#include <utility>

#include "grid_path_planner/search/heuristic.h"

namespace grid_path_planner {
namespace {

Traits traitsOf(const char* name, bool optimal) {
  Traits traits;
  traits.name = name;
  traits.optimal = optimal;
  traits.heuristic = true;
  traits.repairs = true;
  return traits;
}

// Later cells wait: the second key of the open list.
SearchKey tieKey(TieBreak tie_break, SearchKey g, const Estimate& estimate, Cell cell) {
  switch (tie_break) {
    case TieBreak::LARGER_G:
      return kInfiniteKey - g;
    case TieBreak::CROSS_PRODUCT:
      return estimate.cross(cell);
    case TieBreak::NONE:
    case TieBreak::CROSS_PRODUCT_PUBLISHED:
      break;
  }
  return 0;
}

}  // namespace

AStar::AStar(const SearchOptions& options)
    : AStar(traitsOf("a_star", true), options, BestFirstSearch::GoalTest::WHEN_EXPANDED) {}

AStar AStar::published(const SearchOptions& options) {
  return AStar(traitsOf("a_star_published", false), options,
               BestFirstSearch::GoalTest::WHEN_GENERATED);
}

AStar::AStar(Traits traits, const SearchOptions& options, BestFirstSearch::GoalTest goal_test)
    : Planner(std::move(traits)), options_(options), goal_test_(goal_test) {
  checkSearchOptions(options);
}

std::size_t AStar::bytesFor(const GridGeometry& geometry) const {
  return BestFirstSearch::bytesFor(geometry);
}

bool AStar::optimalFor(const CostGrid& map) const {
  return traits().optimal && optimalWith(options_, map);
}

void AStar::doPrepare(const StopToken& stop) {
  search_.prepare(map(), stop);
}

void AStar::doUpdate(const CellRect& changed, const StopToken& stop) {
  search_.update(map(), changed, stop);
}

PlanResult AStar::doPlan(const PlanRequest& request, const StopToken& stop) {
  const Cell goal = request.goals.front();
  const std::uint32_t goal_index = map().geometry().index(goal).value();
  const Estimate estimate(options_, map(), request.start, goal);
  const TieBreak tie_break = options_.tie_break;
  return search_.run(
      map(), request.start, [goal_index](std::uint32_t index) { return index == goal_index; },
      [&estimate, tie_break](SearchKey g, Cell cell) {
        return BestFirstSearch::Promise{saturatingSum(g, estimate(cell)),
                                        tieKey(tie_break, g, estimate, cell)};
      },
      request.record_expanded, stop, goal_test_);
}

}  // namespace grid_path_planner
