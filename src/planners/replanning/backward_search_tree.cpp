#include "planners/replanning/backward_search_tree.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "planners/core/bucket_queue.h"
#include "planners/core/cost_changes.h"
#include "planners/replanning/inconsistency_scan.h"

namespace grid_path_planner::planners {

using base::Statistics, base::Status, base::StopPoll, base::StopToken;
using costmap::CostGrid, costmap::costOfSteps;
using grid::Cell, grid::CellRect;

namespace {

// Half a straight step: see bucket_queue.h.
constexpr unsigned kBucketShift = 20;

// Width of the open list's buckets at weight 1.
constexpr SearchKey kQueueWidth = 2 * kPackedScale.straight;

// See usableFor().
constexpr std::uint64_t kRebuildRatio = 2;

constexpr auto kNoLimit = std::numeric_limits<std::uint64_t>::max();

// Cells that a repair expands for each that was outdated, at most.
constexpr std::uint64_t kRepairedShare = 2;

// What is done in idle time is stopped within a fraction of a millisecond.
constexpr std::uint32_t kPollInterval = 1024;

// How many cells are expanded at first where the tree has no path from the start.
constexpr std::uint64_t kFirstGrowth = 4096;

}  // namespace

void BackwardSearchTree::prepare(const CostGrid& map, const MovePruning& moves) {
  begun_ = built_ = false;
  nodes_.prepare(map, moves);
  repair_search_.prepare(map);
  open_.prepare(map.geometry());
}

void BackwardSearchTree::begin(const CostGrid& map, Cell goal, Cell start) {
  begun_ = true;
  built_ = grown_ = repairing_ = overflowed_ = false;
  path_.clear();
  outdated_.clear();
  removed_ = opened_ = 0;
  consistent_below_ = kInfiniteKey;
  expanded_ = repair_expanded_ = 0;
  limit_ = kNoLimit;
  goal_ = goal;
  nodes_.setMap(map);
  nodes_.reset(map.geometry().index(goal).value());
  keys_.reset(nodes_, map, start);
  growing_.reset(keys_.of(nodes_.root()), kBucketShift);
  growing_.push(keys_.of(nodes_.root()), nodes_.root());
}

Status BackwardSearchTree::build(const CostGrid& map, Cell goal, Cell start, double extra,
                                 bool record, SearchResult& result, const StopToken& stop) {
  begin(map, goal, start);
  grow(map, start, extra, record, result, stop);
  return plan(map, start, record, result, stop);
}

void BackwardSearchTree::grow(const CostGrid& map, Cell start, double extra, bool record,
                              SearchResult& result, const StopToken& stop) {
  nodes_.setMap(map);
  keys_.moveStart(start);
  const Index from = map.geometry().index(start).value();
  Statistics& counts = result.statistics;
  StopPoll poll(stop, kPollInterval);
  const auto push = [this](Index index) { growing_.push(keys_.of(index), index); };

  removeOutdated(poll);
  while (!grown_ && !growing_.empty() && !grownEnough(from, extra)) {
    poll();
    counts.peak_open = std::max(counts.peak_open, growing_.size());
    const Index index = growing_.pop();
    if (nodes_.state(index) != BackwardNodes::OPEN) continue;
    ++(repairing_ ? repaired_ : expanded_);
    ++counts.expanded;
    if (record) result.expanded.emplace_back(index);
    expand(index, counts, push);
  }
  keepFrontier(from, poll);
}

// Until no open cell can lower the g-value of the start, and `extra` times as many cells more; a repair
// until all is known again, but not beyond: some cells are expanded twice, and others have no path.
bool BackwardSearchTree::grownEnough(Index from, double extra) {
  if (repairing_) return repaired_ >= kRepairedShare * to_repair_;
  const bool found = nodes_.state(from) != BackwardNodes::NEW &&
                     growing_.lowest() >= keys_.withKeyModifier(nodes_.g(from));
  if (found && limit_ == kNoLimit)
    limit_ = expanded_ + static_cast<std::uint64_t>(extra * static_cast<double>(expanded_));
  return expanded_ >= limit_;
}

// The frontier stays open for later plans.
void BackwardSearchTree::keepFrontier(Index from, StopPoll& poll) {
  if (!grown_ && !repairing_) {
    const bool reached = nodes_.state(from) != BackwardNodes::NEW;
    open_.reset(reached ? keys_.withKeyModifier(nodes_.g(from)) : 0,
                kQueueWidth * std::max<SearchKey>(keys_.scale(), 1));
  }
  grown_ = true;
  while (!growing_.empty()) {
    poll();
    const Index index = growing_.pop();
    if (nodes_.state(index) == BackwardNodes::OPEN) open_.push(keys_, index);
  }
  built_ = true;
  repairing_ = false;
}

bool BackwardSearchTree::growing(const CostGrid& map, Cell goal) const {
  return begun_ && !built_ && validOn(map, goal);
}

bool BackwardSearchTree::validOn(const CostGrid& map, Cell goal) const {
  return goal_ == goal && keys_.scale() <= map.minWeight() && keys_.inRange();
}

bool BackwardSearchTree::usableFor(const CostGrid& map, Cell goal) const {
  return built_ && validOn(map, goal) && repair_expanded_ <= kRebuildRatio * expanded_;
}

template <class Push>
void BackwardSearchTree::relax(Index from, Index to, std::uint32_t step, Statistics& counts,
                               const Push& push) {
  const SearchKey g = nodes_.g(from) + nodes_.stepKey(from, to, step);
  const State is = nodes_.state(to);
  if (is != BackwardNodes::NEW && nodes_.g(to) <= g) return;
  if (g > BackwardNodes::kLargest) {
    overflowed_ = true;
    return;
  }
  if (is == BackwardNodes::CLOSED) ++counts.reopened;
  nodes_.set(to, g, oppositeStep(step), BackwardNodes::OPEN);
  push(to);
  ++counts.generated;
}

template <class Push>
void BackwardSearchTree::expand(Index index, Statistics& counts, const Push& push) {
  nodes_.setState(index, BackwardNodes::CLOSED);
  for (unsigned mask = nodes_.stepsFrom(index); mask != 0; mask &= mask - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(mask));
    relax(index, nodes_.along(index, step), step, counts, push);
  }
}

template <class Bound, class Lowered>
std::uint64_t BackwardSearchTree::advance(const Bound& bound, const Lowered& lowered,
                                          std::uint64_t limit, bool record, SearchResult& result,
                                          StopPoll& poll) {
  const auto push = [&](Index index) {
    open_.push(keys_, index);
    lowered(index);
  };
  Statistics& counts = result.statistics;
  std::uint64_t expanded = 0;
  while (expanded < limit) {
    poll();
    if (open_.first(bound(), keys_) == nullptr) break;
    counts.peak_open = std::max(counts.peak_open, open_.size());
    const TiledOpenList::Entry entry = open_.pop();
    if (nodes_.state(entry.index) != BackwardNodes::OPEN) continue;
    if (keys_.of(entry.index) > entry.key) {
      open_.push(keys_, entry.index);
      continue;
    }
    if (++expanded == 1) outdated_.restart();
    ++counts.expanded;
    if (record) result.expanded.emplace_back(entry.index);
    expand(entry.index, counts, push);
  }
  return expanded;
}

Status BackwardSearchTree::plan(const CostGrid& map, Cell start, bool record, SearchResult& result,
                                const StopToken& stop, std::uint64_t most) {
  const std::uint64_t before = result.statistics.expanded;
  const auto left = [&] {
    const std::uint64_t spent = result.statistics.expanded - before;
    if (spent >= most) throw TooManyCells();
    return most - spent;
  };
  nodes_.setMap(map);
  const Index from = map.geometry().index(start).value();
  StopPoll poll(stop);
  keys_.moveStart(start);
  if (lastPathHolds(map, result)) return Status::FOUND;
  const auto unbounded = [] { return kInfiniteKey; };
  const auto below_start = [&] {
    const bool reached = nodes_.state(from) != BackwardNodes::NEW;
    return reached ? keys_.withKeyModifier(nodes_.g(from)) : kInfiniteKey;
  };
  const auto below_path = [this] { return keys_.withKeyModifier(repair_search_.cost()); };
  const auto ignore = [](Index) {};
  bool affected = false;
  const auto checkPath = [&](Index index) {
    affected = affected || repair_search_.affects(nodes_, index);
  };
  std::uint64_t growth = kFirstGrowth;
  while (true) {
    // 1. Cost decreases are propagated as far as they may lower the g-value of the start.
    advance(below_start, ignore, left(), record, result, poll);
    left();
    if (nodes_.state(from) == BackwardNodes::NEW) return unreachable();

    // 2. A path around the cost increases; cost decreases that may lower its cost.
    const bool found =
        repair_search_.run(nodes_, from, consistent_below_, record, result, poll, left());
    repair_expanded_ += repair_search_.expanded();
    if (found) {
      affected = false;
      advance(below_path, checkPath, left(), record, result, poll);
      left();
      if (affected) continue;
      path_ = repair_search_.path(nodes_);
      path_cost_ = exactCostOf(repair_search_.cost(), kPackedScale) * map.kernel();
      result.cells = path_;
      result.cost = path_cost_;
      return Status::FOUND;
    }

    // 3. No path over the cells of the tree: the tree grows.
    overflowed_ = overflowed_ || repair_search_.overflowed();
    if (!repair_search_.leftTheTree()) return unreachable();
    if (advance(unbounded, ignore, std::min(growth, left()), record, result, poll) == 0)
      return unreachable();
    growth *= 2;
  }
}

bool BackwardSearchTree::lastPathHolds(const CostGrid& map, SearchResult& result) {
  const auto at = std::find(path_.begin(), path_.end(), keys_.start());
  if (at == path_.end()) return false;
  path_cost_ = path_cost_ - costOfSteps(map, {path_.begin(), at + 1});
  path_.erase(path_.begin(), at);
  result.cells = path_;
  result.cost = path_cost_;
  return true;
}

Status BackwardSearchTree::unreachable() const {
  if (overflowed_) throw TooExpensive();
  return Status::UNREACHABLE;
}

void BackwardSearchTree::update(const CostGrid& before, const CostGrid& after,
                                const CellRect& changed) {
  if (!begun_) return;
  nodes_.setMap(after);
  const CellRect all = after.geometry().rect();
  const auto around = [&all](const CellRect& rect) {
    return rect.empty() ? rect : rect.grown(1).intersection(all);
  };
  const CostChanges changes =
      costChanges(before.weights(), after.weights(), changed.intersection(all));
  const CellRect increased = around(changes.increased), decreased = around(changes.decreased);
  const auto isIncreased = [&](Cell cell) { return increased.contains(cell); };
  if (!decreased.empty() || std::any_of(path_.begin(), path_.end(), isIncreased)) path_.clear();
  onCostIncrease(increased);
  onCostDecrease(decreased);
}

// g-values decrease along a path, and a path out of the rectangle passes a cell of its border. So
// paths from cells with lower g-values than all of the border's do not pass the rectangle.
void BackwardSearchTree::onCostIncrease(const CellRect& rect) {
  if (rect.empty()) return;
  outdated_.add(nodes_, rect);
  if (rect.contains(goal_)) consistent_below_ = 0;
  const auto lowerBound = [this](int column, int row) {
    const auto index = static_cast<Index>(nodes_.geometry().index({column, row}).value());
    if (nodes_.state(index) != BackwardNodes::NEW)
      consistent_below_ = std::min(consistent_below_, nodes_.g(index));
  };
  const Cell last{rect.column + rect.width - 1, rect.row + rect.height - 1};
  for (int row = rect.row; row <= last.row; ++row) {
    lowerBound(rect.column, row);
    lowerBound(last.column, row);
  }
  for (int column = rect.column; column <= last.column; ++column) {
    lowerBound(column, rect.row);
    lowerBound(column, last.row);
  }
}

// Opens the cells that may lower the g-value of a neighbour: see the invariant.
void BackwardSearchTree::onCostDecrease(const CellRect& rect) {
  if (rect.empty()) return;
  nodes_.prefetchRows(rect);
  InconsistencyScan scan(nodes_, rect);
  scan.forEachSuspect([&](Cell cell) {
    const auto index = static_cast<Index>(nodes_.geometry().index(cell).value());
    const bool east = cell.column + 1 < rect.column + rect.width;
    const bool north = cell.row + 1 < rect.row + rect.height;
    if (east) checkStep(index, 0);
    if (north) checkStep(index, 1);
    if (east && north) {
      checkStep(index, 4);
      checkStep(index + 1, 5);
    }
  });
}

void BackwardSearchTree::checkStep(Index index, std::uint32_t step) {
  const Index other = nodes_.along(index, step);
  const SearchKey length = nodes_.stepKey(index, other, step);
  const bool known = nodes_.state(index) != BackwardNodes::NEW;
  const bool other_known = nodes_.state(other) != BackwardNodes::NEW;
  if (known && (!other_known || nodes_.g(other) > nodes_.g(index) + length))
    markInconsistent(index, step);
  else if (other_known && (!known || nodes_.g(index) > nodes_.g(other) + length))
    markInconsistent(other, oppositeStep(step));
}

void BackwardSearchTree::markInconsistent(Index index, std::uint32_t step) {
  if (nodes_.state(index) != BackwardNodes::CLOSED || (nodes_.stepsFrom(index) >> step & 1U) == 0)
    return;
  open(index);
}

void BackwardSearchTree::beginRepair(const CostGrid& map, Cell start, const StopToken& stop) {
  nodes_.setMap(map);
  keys_.moveStart(start);
  StopPoll poll(stop, kPollInterval);
  outdated_.find(nodes_, poll);
  path_.clear();
  built_ = grown_ = false;
  repairing_ = true;
  repaired_ = 0;
  to_repair_ = outdated_.cells().size();
  removed_ = opened_ = 0;
  repair_expanded_ = 0;
  growing_.reset(keys_.of(nodes_.root()), kBucketShift);
}

// Then opens the cells around them: see the invariant.
void BackwardSearchTree::removeOutdated(StopPoll& poll) {
  const std::vector<Index>& cells = outdated_.cells();
  for (; removed_ < cells.size(); ++removed_) {
    poll();
    nodes_.remove(cells[removed_]);
  }
  for (; opened_ < cells.size(); ++opened_) {
    poll();
    openAround(cells[opened_]);
  }
  outdated_.removed();
  removed_ = opened_ = 0;
  if (outdated_.noneAdded()) consistent_below_ = kInfiniteKey;
}

void BackwardSearchTree::openAround(Index index) {
  for (unsigned mask = nodes_.stepsFrom(index); mask != 0; mask &= mask - 1) {
    const Index other = nodes_.along(index, static_cast<std::uint32_t>(__builtin_ctz(mask)));
    if (nodes_.state(other) == BackwardNodes::CLOSED) open(other);
  }
}

void BackwardSearchTree::open(Index index) {
  nodes_.setState(index, BackwardNodes::OPEN);
  if (built_)
    open_.push(keys_, index);
  else
    growing_.push(keys_.of(index), index);
}

}  // namespace grid_path_planner::planners
