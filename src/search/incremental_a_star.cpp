#include "grid_path_planner/search/incremental_a_star.h"

#include <algorithm>
#include <limits>

#include "grid_path_planner/search/heuristic.h"

namespace grid_path_planner {
namespace {

Traits traitsOfIncrementalAStar() {
  Traits traits;
  traits.name = "incremental_a_star";
  traits.optimal = true;
  traits.repairs = true;
  traits.incremental = true;
  return traits;
}

SearchOptions bestEstimate(const MotionModel& motion) {
  SearchOptions options;
  if (motion.connectivity == Connectivity::FOUR)
    options.heuristic = Heuristic::MANHATTAN;
  else if (motion.diagonal_cost == DiagonalCost::UNIT)
    options.heuristic = Heuristic::CHEBYSHEV;
  return options;
}

// How many times as many cells are labelled for a new goal as its first plan takes.
constexpr std::uint64_t kAhead = 3;

// A repair that takes more than this part of the cells of a fresh search is put off: a cell that
// is repaired costs several times as much as one that A* expands. Less than the least is not worth
// beginning.
constexpr double kRepairShare = 1.0 / 20.0;
constexpr std::uint64_t kLeastRepair = 64;

}  // namespace

IncrementalAStar::IncrementalAStar() : Planner(traitsOfIncrementalAStar()) {}

std::size_t IncrementalAStar::bytesFor(const GridGeometry& geometry) const {
  return GoalTree::bytesFor(geometry) + BucketSearch::bytesFor(geometry);
}

void IncrementalAStar::doPrepare(const StopToken& stop) {
  fresh_.prepare(map(), stop);
  tree_.prepare(map(), fresh_.moves());
}

void IncrementalAStar::doUpdate(const CellRect& changed, const StopToken& stop) {
  fresh_.update(map(), changed, stop);
  try {
    tree_.update(mapBefore(), map(), changed);
  } catch (const CostOverflow&) {
    tree_.forget();
  }
}

// The cells of a fresh search are guessed from those of the tree's first: in an open map they are
// as the square of the cost.
std::uint64_t IncrementalAStar::repairLimit(Cell start) const {
  const double part = static_cast<double>(tree_.labelOf(start)) / static_cast<double>(first_cost_);
  const double cells = static_cast<double>(first_expanded_) * std::min(1.0, part * part);
  const auto limit = static_cast<std::uint64_t>(kRepairShare * cells);
  return limit < kLeastRepair ? 0 : limit;
}

PlanResult IncrementalAStar::doPlan(const PlanRequest& request, const StopToken& stop) {
  PlanResult result;
  GoalTree::Outcome outcome = GoalTree::Outcome::LIMIT;
  try {
    outcome = planByTree(request, result, stop);
  } catch (const CostOverflow&) {
    tree_.forget();
  } catch (const Stopped& stopped) {
    result.status = stopped.status();
    result.statistics.search_bytes = bytesFor(map().geometry()) + tree_.queueBytes();
    return result;
  }
  if (outcome == GoalTree::Outcome::LIMIT) return planAfresh(request, result, stop);
  result.status = outcome == GoalTree::Outcome::FOUND ? Status::FOUND : Status::UNREACHABLE;
  result.statistics.search_bytes = bytesFor(map().geometry()) + tree_.queueBytes();
  return result;
}

GoalTree::Outcome IncrementalAStar::planByTree(const PlanRequest& request, PlanResult& result,
                                               const StopToken& stop) {
  const Cell goal = request.goals.front();
  const bool record = request.record_expanded;
  if (tree_.serves(map(), goal)) {
    const auto outcome =
        tree_.repair(map(), request.start, repairLimit(request.start), record, result, stop);
    strategies_.repaired += outcome == GoalTree::Outcome::LIMIT ? 0 : 1;
    return outcome;
  }
  const auto outcome = tree_.begin(map(), goal, request.start, kAhead, record, result, stop);
  ++strategies_.begun;
  first_expanded_ = result.statistics.expanded;
  first_cost_ = std::max<SearchKey>(1, tree_.labelOf(request.start));
  return outcome;
}

PlanResult IncrementalAStar::planAfresh(const PlanRequest& request, const PlanResult& so_far,
                                        const StopToken& stop) {
  ++strategies_.fresh;
  const Cell goal = request.goals.front();
  const std::uint32_t goal_index = map().geometry().index(goal).value();
  const auto isGoal = [goal_index](std::uint32_t index) { return index == goal_index; };
  const auto run = [&](const auto& estimateIn) {
    return fresh_.run(map(), request.start, isGoal, estimateIn, request.record_expanded, stop);
  };
  const auto octile = [&](const KeyScale& scale) {
    return [estimate = OctileEstimate(map(), goal, scale)](Cell cell, std::uint32_t) {
      return estimate(cell);
    };
  };
  const SearchOptions options = bestEstimate(map().motion());
  const auto general = [&](const KeyScale& scale) {
    return [estimate = Estimate(options, map(), request.start, goal, scale)](
               Cell cell, std::uint32_t) { return estimate(cell); };
  };
  const bool plain = Estimate(options, map(), request.start, goal).plainOctile();
  PlanResult result = plain ? run(octile) : run(general);
  result.expanded.insert(result.expanded.begin(), so_far.expanded.begin(), so_far.expanded.end());
  const std::size_t bytes = result.statistics.search_bytes;
  result.statistics += so_far.statistics;
  result.statistics.search_bytes =
      bytes + GoalTree::bytesFor(map().geometry()) + tree_.queueBytes();
  return result;
}

}  // namespace grid_path_planner
