#include "planning/multi_resolution_planner.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "grid_path_planner/planners/reachable_cells.h"

namespace grid_path_planner::planning {

using base::Status, base::StopPoll, base::StopToken;
using costmap::CostChanges, costmap::CostGrid;
using grid::Cell, grid::CellIndex, grid::CellRect, grid::GridGeometry;
using planners::BucketSearch, planners::noEstimate, planners::memoryLimitOf, planners::PlannerMaker,
    planners::reachableFrom, planners::SearchOptions, planners::SearchResult;

namespace {

// Adds the result of a search to the route's plan, and a leg where it found a path.
void append(Route& route, const std::shared_ptr<const CostGrid>& map, SearchResult result) {
  Plan& plan = route.plan;
  plan.status = result.status;
  plan.message = std::move(result.message);
  plan.statistics += result.statistics;
  if (!result.answered_by.empty()) plan.answered_by = std::move(result.answered_by);
  for (const CellIndex index : result.expanded)
    plan.expanded.push_back(map->waypoint(map->geometry().cell(index)));
  if (!plan.found()) return;
  plan.cost += result.cost;
  plan.segment_cost += result.segment_cost;
  result.expanded = {};
  route.legs.push_back({map, std::move(result)});
}

SearchResult tooLarge() {
  SearchResult result;
  result.status = Status::INVALID_REQUEST;
  result.message =
      "an end lies in a blocked block, and to search at full resolution takes more than "
      "memory_limit leaves";
  return result;
}

// Adds what another search did and how it ended, but not its path.
void addSearch(Plan& plan, const Plan& other) {
  plan.status = other.status;
  plan.statistics += other.statistics;
  plan.expanded.insert(plan.expanded.end(), other.expanded.begin(), other.expanded.end());
}

// nullopt where that is not known.
std::optional<std::vector<CellRect>> changesSince(const std::shared_ptr<const CostGrid>& map,
                                                  const CostChanges& changes) {
  auto change = map ? changes.since(map->revision()) : std::nullopt;
  return change ? std::make_optional(std::move(change->weights)) : std::nullopt;
}

// Searches for questions that may come follow a change of up to this share of the map: more would
// delay the answer to one that is asked.
constexpr std::size_t kFollowedShare = 16;

bool isSmall(const std::vector<CellRect>& change, const GridGeometry& geometry) {
  std::size_t cells = 0;
  for (const CellRect& rect : change)
    cells += static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height);
  return cells * kFollowedShare <= geometry.size();
}

}  // namespace

MultiResolutionPlanner::MultiResolutionPlanner(std::string planner, const SearchOptions& options,
                                               PlannerMaker make_planner)
    : make_planner_(std::move(make_planner)),
      planner_name_(std::move(planner)),
      options_(options),
      memory_limit_(memoryLimitOf(options)),
      planner_(make_planner_(planner_name_, options)) {}

void MultiResolutionPlanner::prepare(const CostmapPair& maps, const StopToken& stop) {
  if (full_resolution_ != maps.full_resolution) followFullResolution(maps, stop);
  if (downsampled_ == maps.downsampled) return;
  // A stopped preparation begins anew.
  const std::shared_ptr<const CostGrid> before = std::exchange(downsampled_, nullptr);
  const auto changed = changesSince(before, maps.downsampled_changes);
  planner_->limitMemory(memory_limit_);
  if (changed)
    planner_->update(maps.downsampled, *changed, stop);
  else
    planner_->prepare(maps.downsampled, stop);
  downsampled_ = maps.downsampled;
}

std::size_t MultiResolutionPlanner::bytes() const {
  std::size_t bytes = 0;
  if (downsampled_) bytes += planner_->bytesFor(downsampled_->geometry());
  if (finer_map_) bytes += finer_planner_->bytesFor(finer_map_->geometry());
  if (open_block_map_) bytes += BucketSearch::bytesFor(open_block_map_->geometry());
  return bytes;
}

void MultiResolutionPlanner::releaseOptionalMemory() {
  planner_->releaseOptionalMemory();
  if (finer_planner_) finer_planner_->releaseOptionalMemory();
}

void MultiResolutionPlanner::makeRoomFor(std::size_t bytes) {
  if (this->bytes() + bytes > memory_limit_) releaseOptionalMemory();
}

std::size_t MultiResolutionPlanner::bytesFor(const GridGeometry& downsampled) const {
  return std::max(bytes(), planner_->bytesFor(downsampled));
}

bool MultiResolutionPlanner::canFollow(const CostmapPair& maps) const {
  if (!planner_->traits().repairs) return false;
  const auto changed = changesSince(downsampled_, maps.downsampled_changes);
  const auto changed_full = changesSince(full_resolution_, maps.full_resolution_changes);
  return changed && changed_full && isSmall(*changed, maps.downsampled->geometry()) &&
         isSmall(*changed_full, maps.full_resolution->geometry());
}

void MultiResolutionPlanner::follow(const CostmapPair& maps, const StopToken& stop) {
  if (downsampled_ && planner_->traits().repairs) prepare(maps, stop);
}

void MultiResolutionPlanner::followFullResolution(const CostmapPair& maps, const StopToken& stop) {
  const std::shared_ptr<const CostGrid> before =
      std::exchange(full_resolution_, maps.full_resolution);
  const auto changed = changesSince(before, maps.full_resolution_changes);
  const bool update_finer = changed && finer_map_ == before && finer_planner_->traits().repairs;
  const bool update_open_block = changed && open_block_map_ == before;
  finer_map_.reset();
  open_block_map_.reset();
  if (update_finer) {
    finer_planner_->update(full_resolution_, *changed, stop);
    finer_map_ = full_resolution_;
  }
  if (update_open_block) {
    open_block_search_->update(*full_resolution_, *changed, stop);
    open_block_map_ = full_resolution_;
  }
}

Cell MultiResolutionPlanner::middleOf(Cell block) const {
  const int k = downsampled_->kernel();
  const auto middle = [k](int first, int side) { return first + std::min(k, side - first) / 2; };
  return {middle(block.column * k, full_resolution_->geometry().width()),
          middle(block.row * k, full_resolution_->geometry().height())};
}

Route MultiResolutionPlanner::find(Cell start, Cell goal, bool retry_finer, bool record_expanded,
                                   const StopToken& stop) {
  assert(full_resolution_ && downsampled_);
  assert(full_resolution_->passable(start) && full_resolution_->passable(goal));
  if (downsampled_->kernel() == 1) return findOnKernelOne(start, goal, record_expanded, stop);
  Route route = findOverBlocks(start, goal, record_expanded, stop);
  if (route.plan.status != Status::UNREACHABLE || !retry_finer) return route;

  Route finer = findAtFullResolution(start, goal, record_expanded, stop);
  finer.plan.statistics += route.plan.statistics;
  finer.plan.expanded.insert(finer.plan.expanded.begin(), route.plan.expanded.begin(),
                             route.plan.expanded.end());
  if (finer.plan.found())
    finer.plan.message = "kernel " + std::to_string(downsampled_->kernel()) +
                         " closes all paths: planned again at kernel 1";
  return finer;
}

Route MultiResolutionPlanner::findOnKernelOne(Cell start, Cell goal, bool record_expanded,
                                              const StopToken& stop) {
  Route route;
  append(route, downsampled_, planner_->search({start, {goal}, record_expanded}, stop));
  route.shortest = route.plan.found() && planner_->traits().shortest;
  route.plan.optimal =
      route.shortest || (route.plan.found() && planner_->optimalFor(*downsampled_));
  return route;
}

SearchResult MultiResolutionPlanner::searchOpenBlock(Cell from, Cell other, const Blocks& wanted,
                                                     bool record_expanded, const StopToken& stop) {
  if (!open_block_map_) {
    const std::size_t needed = BucketSearch::bytesFor(full_resolution_->geometry());
    makeRoomFor(needed);
    if (bytes() + needed > memory_limit_) return tooLarge();
  }
  if (!open_block_search_) open_block_search_ = std::make_unique<BucketSearch>();
  if (open_block_map_ != full_resolution_) {
    open_block_map_.reset();
    open_block_search_->prepare(*full_resolution_, stop);
    open_block_map_ = full_resolution_;
  }
  const auto arrived = [&](std::uint32_t index) {
    const Cell cell = full_resolution_->geometry().cell(CellIndex(index));
    if (cell == other) return true;
    const Cell block = blockOf(cell);
    return wanted[downsampled_->geometry().index(block).value()] != 0 && middleOf(block) == cell;
  };
  return open_block_search_->run(*full_resolution_, from, arrived, noEstimate, record_expanded,
                                 stop);
}

MultiResolutionPlanner::Blocks MultiResolutionPlanner::openBlocks() const {
  Blocks open;
  for (const CostGrid::Weight weight : downsampled_->weights().values())
    open.push_back(weight != CostGrid::kBlocked ? 1 : 0);
  return open;
}

Route MultiResolutionPlanner::findOverBlocks(Cell start, Cell goal, bool record_expanded,
                                             const StopToken& stop) {
  Route route;
  Plan& plan = route.plan;
  plan.kernel = downsampled_->kernel();

  // 1. From a start in a blocked block to an open one from which the goal's block can be reached.
  Cell first = start;
  if (!blockOpen(start)) {
    const Blocks wanted =
        blockOpen(goal) ? reachableFrom(*downsampled_, blockOf(goal), stop) : openBlocks();
    append(route, full_resolution_, searchOpenBlock(start, goal, wanted, record_expanded, stop));
    if (!plan.found()) return route;
    first = route.legs.back().result.cells.back();
    if (first == goal) return route;
  }

  // 2. The same backwards from the goal.
  Route last_leg;
  Cell last = goal;
  if (!blockOpen(goal)) {
    const Blocks wanted = reachableFrom(*downsampled_, blockOf(first), stop);
    append(last_leg, full_resolution_, searchOpenBlock(goal, start, wanted, record_expanded, stop));
    addSearch(plan, last_leg.plan);
    if (!plan.found()) return route;
    auto& cells = last_leg.legs.back().result.cells;
    std::reverse(cells.begin(), cells.end());
    last = cells.front();
    if (last == start) {
      last_leg.plan.statistics = plan.statistics;
      return last_leg;
    }
  }

  // 3. Over the blocks between.
  append(route, downsampled_,
         planner_->search({blockOf(first), {blockOf(last)}, record_expanded}, stop));
  if (!plan.found() || last_leg.legs.empty()) return route;
  plan.cost += last_leg.plan.cost;
  route.legs.push_back(std::move(last_leg.legs.back()));
  return route;
}

Route MultiResolutionPlanner::findAtFullResolution(Cell start, Cell goal, bool record_expanded,
                                                   const StopToken& stop) {
  if (!finer_planner_) finer_planner_ = make_planner_(planner_name_, options_);
  if (finer_map_ != full_resolution_) {
    finer_map_.reset();
    makeRoomFor(finer_planner_->bytesFor(full_resolution_->geometry()));
    finer_planner_->limitMemory(memory_limit_ - std::min(memory_limit_, bytes()));
    finer_planner_->prepare(full_resolution_, stop);
    finer_map_ = full_resolution_;
  }
  Route route;
  append(route, full_resolution_, finer_planner_->search({start, {goal}, record_expanded}, stop));
  return route;
}

std::vector<std::uint8_t> MultiResolutionPlanner::reachable(Cell start, bool retry_finer,
                                                            const StopToken& stop) {
  std::vector<std::uint8_t> cells = reachableFrom(*full_resolution_, start, stop);
  if (retry_finer || downsampled_->kernel() == 1 || !blockOpen(start)) return cells;
  const Blocks blocks = reachableFrom(*downsampled_, blockOf(start), stop);
  StopPoll poll(stop, 1 << 18);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    poll();
    const Cell cell = full_resolution_->geometry().cell(CellIndex(i));
    if (blockOpen(cell) && blocks[downsampled_->geometry().index(blockOf(cell)).value()] == 0)
      cells[i] = 0;
  }
  return cells;
}

}  // namespace grid_path_planner::planning
