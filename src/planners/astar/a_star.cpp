#include "planners/astar/a_star.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "planners/astar/heuristic.h"

namespace grid_path_planner::planners {

using base::Status, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::CellIndex, grid::CellRect, grid::GridGeometry;

namespace {

// Searches of fewer expansions tell too little of what a bound spares.
constexpr std::size_t kLeastWeighed = 4096;
constexpr std::size_t kSampledCells = 4096;

// The second key of the open list: the least comes first.
SearchKey tieKey(TieBreak tie_break, SearchKey g, const Estimate& estimate, Cell cell) {
  switch (tie_break) {
    case TieBreak::LARGER_G:
      return kInfiniteKey - g;
    case TieBreak::CROSS_PRODUCT:
      return estimate.cross(cell);
    case TieBreak::NONE:
      break;
  }
  return 0;
}

SearchKey stretched(SearchKey bound, double epsilon) {
  if (epsilon == 1.0) return bound;
  const double key = static_cast<double>(bound) * epsilon;
  return key < static_cast<double>(kInfiniteKey) ? static_cast<SearchKey>(key) : kInfiniteKey;
}

// What a table that knows that no path leads from start to goal answers: its infinite bound is no key
// that a search could add to.
std::optional<SearchResult> unreachableBy(SearchKey bound_of_start) {
  if (bound_of_start != kInfiniteKey) return std::nullopt;
  SearchResult result;
  result.status = Status::UNREACHABLE;
  return result;
}

}  // namespace

PlannerTraits AStar::declaredTraits() {
  PlannerTraits traits{"a_star"};
  traits.heuristic = true;
  traits.repairs = true;
  traits.optimal = true;
  return traits;
}

AStar::AStar(const AStarOptions& options)
    : Planner(declaredTraits()),
      options_(options),
      strictly_ordered_(options.tie_break != TieBreak::NONE),
      tables_(options) {
  checkAStarOptions(options);
}

AStar::AStar(const AStarOptions& options, BoundChoice& choice) : AStar(options) {
  choice_ = &choice;
}

std::size_t AStar::bytesFor(const GridGeometry& geometry) const {
  const std::size_t search =
      strictly_ordered_ ? BestFirstSearch::bytesFor(geometry) : BucketSearch::bytesFor(geometry);
  const bool blocks = options_.heuristic == Heuristic::BLOCKS;
  return search + (blocks ? BlockBounds::bytesFor(geometry, kBlock) : 0) +
         PrecomputedHeuristic::bytesFor(options_, geometry);
}

std::string AStar::lessMemoryAdvice() const {
  const std::string advice = PrecomputedHeuristic::lessMemoryAdvice(options_);
  return advice.empty() ? Planner::lessMemoryAdvice() : advice;
}

bool AStar::optimalFor(const CostGrid& map) const {
  return optimalWith(options_, map);
}

void AStar::doPrepare(const StopToken& stop) {
  if (strictly_ordered_)
    in_order_.prepare(map(), stop);
  else
    by_buckets_.prepare(map(), stop);
  blocks_ready_ = false;
  last_ = LastSearch();
  tables_.prepare(sharedMap());
}

void AStar::doUpdate(const std::vector<CellRect>& changed, const StopToken& stop) {
  if (strictly_ordered_)
    in_order_.update(map(), changed, stop);
  else
    by_buckets_.update(map(), changed, stop);
  if (blocks_ready_) blocks_.update(map(), changed);
  last_ = LastSearch();
  tables_.update(previousMap(), sharedMap(), changed);
}

SearchResult AStar::doSearch(const SearchRequest& request, const StopToken& stop) {
  if (learns()) weighLastSearch(stop);
  const bool bounded = useBlocks() || tables_.ready();
  SearchResult result = strictly_ordered_ ? planInOrder(request, stop)
                        : blocksAlone()   ? planWithBlocks(request, stop)
                        : bounded         ? planWithBound(request, stop)
                                          : planByBuckets(request, stop);
  if (learns() && result.status == Status::FOUND)
    last_ = {request.start, request.goals.front(), result.costValue(), result.statistics.expanded};
  result.statistics.search_bytes += tables_.work().bytes;
  if (blocks_ready_)
    result.statistics.search_bytes += BlockBounds::bytesFor(map().geometry(), kBlock);
  return result;
}

// Not on maps of one weight, whose options ask for no blocks.
bool AStar::learns() const {
  return options_.heuristic == Heuristic::BLOCKS && choice_ != nullptr && choice_->undecided();
}

bool AStar::useBlocks() const {
  return options_.heuristic == Heuristic::BLOCKS && (choice_ == nullptr || choice_->blocks());
}

// Whether the bound of the blocks is the whole heuristic: there is no octile distance to enlarge.
bool AStar::blocksAlone() const {
  return useBlocks() && options_.epsilon == 1.0 && !heuristicScale(options_);
}

BlockBound& AStar::boundTo(Cell goal, const StopToken& stop) {
  if (!blocks_ready_) blocks_.prepare(map(), stop);
  blocks_ready_ = true;
  return blocks_.to(goal);
}

// Tells the choice what the bound of the blocks would have spared the last search.
void AStar::weighLastSearch(const StopToken& stop) {
  if (last_.expanded < kLeastWeighed) return;
  BlockBound& bound = boundTo(last_.goal, stop);
  const BlockEstimate blocks(bound, kWideScale, stop);
  if (blocks(last_.start) != kInfiniteKey)
    choice_->learn({last_.expanded, shareSpared(blocks), bound.expanded()});
  last_ = LastSearch();
  if (choice_->undecided() || choice_->blocks()) return;
  blocks_.release();
  blocks_ready_ = false;
}

// Of a sample of the cells that it expanded.
double AStar::shareSpared(const BlockEstimate& blocks) const {
  const Estimate octile(options_, map(), last_.start, last_.goal, kWideScale);
  const auto keyOf = [](double cost) { return SearchKey(cost * double(kWideScale.straight)); };
  const SearchKey cost = keyOf(last_.cost);
  const std::size_t size = map().geometry().size();
  const std::size_t stride = size / kSampledCells | 1;
  std::size_t expanded = 0, spared = 0;
  for (std::size_t index = stride / 2; index < size; index += stride) {
    const double from_start = by_buckets_.costFromStart(std::uint32_t(index));
    if (from_start > last_.cost) continue;
    const SearchKey g = keyOf(from_start);
    const Cell cell = map().geometry().cell(CellIndex(index));
    if (saturatingSum(g, octile(cell)) >= cost) continue;
    ++expanded;
    if (saturatingSum(g, blocks.known(cell)) >= cost) ++spared;
  }
  return expanded == 0 ? 0.0 : double(spared) / double(expanded);
}

// What `search(boundIn)` gives, with the bounds to the goal from blocks or tables.
template <class Search>
SearchResult AStar::withBound(Cell goal, const StopToken& stop, const Search& search) {
  const GridGeometry& geometry = map().geometry();
  if (!useBlocks()) return tables_.withBound(geometry.index(goal).value(), search);
  BlockBound& bound = boundTo(goal, stop);
  return search([&](const KeyScale& scale) {
    return [&geometry, estimate = BlockEstimate(bound, scale, stop)](std::uint32_t index) {
      return estimate(geometry.cell(CellIndex(index)));
    };
  });
}

SearchResult AStar::planWithBlocks(const SearchRequest& request, const StopToken& stop) {
  const Cell goal = request.goals.front();
  const std::uint32_t goal_index = map().geometry().index(goal).value();
  const auto isGoal = [goal_index](std::uint32_t index) { return index == goal_index; };
  BlockBound& bound = boundTo(goal, stop);
  if (auto result = unreachableBy(BlockEstimate(bound, kWideScale, stop)(request.start)))
    return std::move(*result);
  const auto estimateIn = [&](const KeyScale& scale) {
    return [estimate = BlockEstimate(bound, scale, stop)](Cell cell, std::uint32_t) {
      return estimate(cell);
    };
  };
  return by_buckets_.run(map(), request.start, isGoal, estimateIn, request.record_expanded, stop);
}

SearchResult AStar::planWithBound(const SearchRequest& request, const StopToken& stop) {
  const Cell goal = request.goals.front();
  const std::uint32_t goal_index = map().geometry().index(goal).value();
  const auto isGoal = [goal_index](std::uint32_t index) { return index == goal_index; };
  return withBound(goal, stop, [&](const auto& boundIn) {
    const std::uint32_t start_index = map().geometry().index(request.start).value();
    if (auto result = unreachableBy(boundIn(kWideScale)(start_index))) return std::move(*result);
    const auto estimateIn = [&](const KeyScale& scale) {
      return [estimate = Estimate(options_, map(), request.start, goal, scale),
              bound = boundIn(scale), epsilon = options_.epsilon](Cell cell, std::uint32_t index) {
        return std::max(estimate(cell), stretched(bound(index), epsilon));
      };
    };
    return by_buckets_.run(map(), request.start, isGoal, estimateIn, request.record_expanded, stop);
  });
}

SearchResult AStar::planByBuckets(const SearchRequest& request, const StopToken& stop) {
  const Cell goal = request.goals.front();
  const std::uint32_t goal_index = map().geometry().index(goal).value();
  const auto isGoal = [goal_index](std::uint32_t index) { return index == goal_index; };
  const auto plainOctile = [&](const KeyScale& scale) {
    return [estimate = OctileEstimate(map(), goal, scale)](Cell cell, std::uint32_t) {
      return estimate(cell);
    };
  };
  const auto general = [&](const KeyScale& scale) {
    return [estimate = Estimate(options_, map(), request.start, goal, scale)](
               Cell cell, std::uint32_t) { return estimate(cell); };
  };
  if (Estimate(options_, map(), request.start, goal).plainOctile())
    return by_buckets_.run(map(), request.start, isGoal, plainOctile, request.record_expanded,
                           stop);
  return by_buckets_.run(map(), request.start, isGoal, general, request.record_expanded, stop);
}

SearchResult AStar::planInOrder(const SearchRequest& request, const StopToken& stop) {
  const Cell goal = request.goals.front();
  const std::uint32_t goal_index = map().geometry().index(goal).value();
  const Estimate estimate(options_, map(), request.start, goal);
  const TieBreak tie_break = options_.tie_break;
  const GridGeometry& geometry = map().geometry();
  const auto isGoal = [goal_index](std::uint32_t index) { return index == goal_index; };
  return withBound(goal, stop, [&](const auto& boundIn) {
    const auto bound = boundIn(kWideScale);
    if (auto result = unreachableBy(bound(geometry.index(request.start).value())))
      return std::move(*result);
    const auto priorityOf = [&](SearchKey g, Cell cell) {
      const SearchKey least = stretched(bound(geometry.index(cell).value()), options_.epsilon);
      return BestFirstSearch::Priority{saturatingSum(g, std::max(estimate(cell), least)),
                                       tieKey(tie_break, g, estimate, cell)};
    };
    return in_order_.run(map(), request.start, isGoal, priorityOf, request.record_expanded, stop);
  });
}

}  // namespace grid_path_planner::planners
