#include "grid_path_planner/planning/multi_resolution_planner.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "grid_path_planner/planners/steps.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopPoll;
using base::StopToken;
using costmap::CostGrid;
using grid::Cell;
using grid::CellIndex;
using planners::BucketSearch;
using planners::noEstimate;
using planners::PlannerMaker;
using planners::reachableFrom;
using planners::SearchOptions;
using planners::SearchResult;

namespace {

// Adds a search's answer to the route; its cells only where it found some.
void append(Route& route, const std::shared_ptr<const CostGrid>& map, SearchResult result) {
  route.status = result.status;
  route.message = std::move(result.message);
  route.statistics += result.statistics;
  for (const CellIndex index : result.expanded)
    route.expanded.push_back(map->waypoint(map->geometry().cell(index)));
  if (result.status != Status::FOUND) return;
  route.cost += result.cost;
  route.segment_cost += result.segment_cost;
  route.legs.push_back({map, std::move(result.cells), std::move(result.points)});
}

}  // namespace

MultiResolutionPlanner::MultiResolutionPlanner(std::string planner, const SearchOptions& options,
                                               PlannerMaker make_planner)
    : make_planner_(std::move(make_planner)),
      planner_name_(std::move(planner)),
      options_(options),
      planner_(make_planner_(planner_name_, options)) {}

void MultiResolutionPlanner::prepare(const CostmapPair& maps, const StopToken& stop) {
  if (fine_ != maps.full_resolution) followFine(maps, stop);
  if (searched_ == maps.downsampled) return;
  searched_.reset();  // a stopped preparation begins anew
  planner_->update(maps.downsampled, maps.downsampled_change, stop);
  searched_ = maps.downsampled;
}

void MultiResolutionPlanner::follow(const CostmapPair& maps, const StopToken& stop) {
  if (searched_ && planner_->traits().repairs) prepare(maps, stop);
}

void MultiResolutionPlanner::followFine(const CostmapPair& maps, const StopToken& stop) {
  const std::shared_ptr<const CostGrid> before = std::exchange(fine_, maps.full_resolution);
  const bool next = before && before->geometry() == fine_->geometry() &&
                    before->revision() + 1 == fine_->revision();
  const bool finer_follows = next && finer_map_ == before && finer_->traits().repairs;
  const bool leaver_follows = next && leaver_map_ == before;
  finer_map_.reset();
  leaver_map_.reset();
  if (finer_follows) {
    finer_->update(fine_, maps.full_resolution_change, stop);
    finer_map_ = fine_;
  }
  if (leaver_follows) {
    leaver_->update(*fine_, maps.full_resolution_change, stop);
    leaver_map_ = fine_;
  }
}

Cell MultiResolutionPlanner::middleOf(Cell block) const {
  const int k = searched_->kernel();
  const auto middle = [k](int first, int side) { return first + std::min(k, side - first) / 2; };
  return {middle(block.column * k, fine_->geometry().width()),
          middle(block.row * k, fine_->geometry().height())};
}

Route MultiResolutionPlanner::find(Cell start, Cell goal, bool retry_finer, bool record_expanded,
                                   const StopToken& stop) {
  assert(fine_ && searched_ && fine_->passable(start) && fine_->passable(goal));
  if (searched_->kernel() == 1) {
    Route route;
    append(route, searched_, planner_->search({start, {goal}, record_expanded}, stop));
    route.taut = route.status == Status::FOUND && planner_->traits().shortest;
    route.optimal =
        route.taut || (route.status == Status::FOUND && planner_->optimalFor(*searched_));
    return route;
  }
  Route route = findOverBlocks(start, goal, record_expanded, stop);
  if (route.status != Status::UNREACHABLE || !retry_finer) return route;

  Route finer = findFine(start, goal, record_expanded, stop);
  finer.statistics += route.statistics;
  finer.expanded.insert(finer.expanded.begin(), route.expanded.begin(), route.expanded.end());
  if (finer.status == Status::FOUND)
    finer.message = "kernel " + std::to_string(searched_->kernel()) +
                    " closes the way: planned again at kernel 1";
  return finer;
}

SearchResult MultiResolutionPlanner::leave(Cell from, Cell other, const Blocks& wanted,
                                           bool record_expanded, const StopToken& stop) {
  if (!leaver_) leaver_ = std::make_unique<BucketSearch>();
  if (leaver_map_ != fine_) {
    leaver_map_.reset();
    leaver_->prepare(*fine_, stop);
    leaver_map_ = fine_;
  }
  const auto arrived = [&](std::uint32_t index) {
    const Cell cell = fine_->geometry().cell(CellIndex(index));
    if (cell == other) return true;
    const Cell block = blockOf(cell);
    return wanted[searched_->geometry().index(block).value()] != 0 && middleOf(block) == cell;
  };
  return leaver_->run(*fine_, from, arrived, noEstimate, record_expanded, stop);
}

MultiResolutionPlanner::Blocks MultiResolutionPlanner::openBlocks() const {
  Blocks open;
  for (const CostGrid::Weight weight : searched_->weights().values())
    open.push_back(weight != CostGrid::kBlocked ? 1 : 0);
  return open;
}

Route MultiResolutionPlanner::findOverBlocks(Cell start, Cell goal, bool record_expanded,
                                             const StopToken& stop) {
  Route route;
  route.kernel = searched_->kernel();

  // 1. From a start in a blocked block to an open one from which the goal's block can be reached.
  Cell first = start;
  if (!blockOpen(start)) {
    const Blocks wanted =
        blockOpen(goal) ? reachableFrom(*searched_, blockOf(goal), stop) : openBlocks();
    append(route, fine_, leave(start, goal, wanted, record_expanded, stop));
    if (route.status != Status::FOUND) return route;
    first = route.legs.back().cells.back();
    if (first == goal) return route;
  }

  // 2. The same backwards from the goal.
  Route last_leg;
  Cell last = goal;
  if (!blockOpen(goal)) {
    const Blocks wanted = reachableFrom(*searched_, blockOf(first), stop);
    append(last_leg, fine_, leave(goal, start, wanted, record_expanded, stop));
    route.statistics += last_leg.statistics;
    route.expanded.insert(route.expanded.end(), last_leg.expanded.begin(), last_leg.expanded.end());
    route.status = last_leg.status;
    if (last_leg.status != Status::FOUND) return route;
    auto& cells = last_leg.legs.back().cells;
    std::reverse(cells.begin(), cells.end());
    last = cells.front();
    if (last == start) {
      last_leg.statistics = route.statistics;
      return last_leg;
    }
  }

  // 3. Over the blocks between.
  append(route, searched_,
         planner_->search({blockOf(first), {blockOf(last)}, record_expanded}, stop));
  if (route.status != Status::FOUND || last_leg.legs.empty()) return route;
  route.cost += last_leg.cost;
  route.legs.push_back(std::move(last_leg.legs.back()));
  return route;
}

Route MultiResolutionPlanner::findFine(Cell start, Cell goal, bool record_expanded,
                                       const StopToken& stop) {
  if (!finer_) finer_ = make_planner_(planner_name_, options_);
  if (finer_map_ != fine_) {
    finer_map_.reset();
    finer_->prepare(fine_, stop);
    finer_map_ = fine_;
  }
  Route route;
  append(route, fine_, finer_->search({start, {goal}, record_expanded}, stop));
  return route;
}

std::vector<std::uint8_t> MultiResolutionPlanner::reachable(Cell start, bool retry_finer,
                                                            const StopToken& stop) {
  std::vector<std::uint8_t> cells = reachableFrom(*fine_, start, stop);
  if (retry_finer || searched_->kernel() == 1 || !blockOpen(start)) return cells;
  const Blocks blocks = reachableFrom(*searched_, blockOf(start), stop);
  StopPoll poll(stop, 1 << 18);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    poll();
    const Cell cell = fine_->geometry().cell(CellIndex(i));
    if (blockOpen(cell) && blocks[searched_->geometry().index(blockOf(cell)).value()] == 0)
      cells[i] = 0;
  }
  return cells;
}

}  // namespace grid_path_planner::planning
