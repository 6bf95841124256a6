#include "planners/replanning/backward_search_tree.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "grid_path_planner/planners/bucket_queue.h"
#include "planners/replanning/cost_decreases.h"
#include "planners/replanning/inconsistency_scan.h"

namespace grid_path_planner::planners {

using base::Statistics;
using base::Status;
using base::StopPoll;
using base::StopToken;
using costmap::CostGrid;
using costmap::costOfSteps;
using grid::Cell;
using grid::CellRect;

namespace {

// Half a straight step: see bucket_queue.h.
constexpr unsigned kBucketShift = 20;

// Of the buckets of what waits for repairs, times the cheapest weight.
constexpr SearchKey kQueueWidth = 2 * kPackedScale.straight;

// See serves().
constexpr std::uint64_t kWorn = 2;

// Of cells by which the tree grows at first where it holds no way from the start.
constexpr std::uint64_t kFirstFurther = 4096;

}  // namespace

void BackwardSearchTree::prepare(const CostGrid& map, const MovePruning& moves) {
  begun_ = false;
  nodes_.prepare(map, moves);
  repair_search_.prepare(map);
  open_.prepare(map.geometry());
}

void BackwardSearchTree::setRoot(const CostGrid& map, Cell goal, Cell start) {
  overflowed_ = false;
  consistent_below_ = kInfiniteKey;
  goal_ = goal;
  nodes_.begin(map.geometry().index(goal).value());
  keys_.begin(nodes_, map, start);
}

Status BackwardSearchTree::begin(const CostGrid& map, Cell goal, Cell start, double ahead,
                                 bool record, SearchResult& result, const StopToken& stop) {
  begun_ = false;
  path_.clear();
  nodes_.setMap(map);
  setRoot(map, goal, start);
  const Index from = map.geometry().index(start).value();
  Statistics& counts = result.statistics;
  StopPoll poll(stop);
  BucketQueue open;
  open.begin(keys_.of(nodes_.root()), kBucketShift);
  const auto wait = [&](Index index) { open.push(keys_.of(index), index); };
  wait(nodes_.root());

  // 1. Until nothing that waits can make the way from the start cheaper; 2. and some more.
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
  bool found = false;
  while (!open.empty() && counts.expanded < limit) {
    poll();
    counts.peak_open = std::max(counts.peak_open, open.size());
    if (!found && nodes_.state(from) != BackwardNodes::UNLABELLED &&
        open.lowest() >= nodes_.g(from)) {
      found = true;
      limit = counts.expanded +
              static_cast<std::uint64_t>(ahead * static_cast<double>(counts.expanded));
    }
    const Index index = open.pop();
    if (nodes_.state(index) != BackwardNodes::OPEN) continue;
    ++counts.expanded;
    if (record) result.expanded.emplace_back(index);
    expand(index, counts, wait);
  }

  expanded_ = counts.expanded;
  detoured_ = 0;

  // 3. What still waits does so for later plans.
  const bool reached = nodes_.state(from) != BackwardNodes::UNLABELLED;
  open_.begin(reached ? nodes_.g(from) : 0, kQueueWidth * std::max<SearchKey>(keys_.scale(), 1));
  while (!open.empty()) {
    const Index index = open.pop();
    if (nodes_.state(index) == BackwardNodes::OPEN) open_.push(keys_, index);
  }
  begun_ = true;
  return plan(map, start, record, result, stop);
}

bool BackwardSearchTree::usableFor(const CostGrid& map, Cell goal) const {
  return begun_ && goal_ == goal && keys_.scale() <= map.minWeight() && keys_.inRange() &&
         detoured_ <= kWorn * expanded_;
}

template <class Wait>
void BackwardSearchTree::relax(Index from, Index to, std::uint32_t step, Statistics& counts,
                               const Wait& wait) {
  const SearchKey label = nodes_.g(from) + nodes_.stepKey(from, to, step);
  const State is = nodes_.state(to);
  if (is != BackwardNodes::UNLABELLED && nodes_.g(to) <= label) return;
  if (label > BackwardNodes::kLargest) {
    overflowed_ = true;
    return;
  }
  if (is == BackwardNodes::CLOSED) ++counts.reopened;
  nodes_.set(to, label, oppositeStep(step), BackwardNodes::OPEN);
  wait(to);
  ++counts.generated;
}

template <class Wait>
void BackwardSearchTree::expand(Index index, Statistics& counts, const Wait& wait) {
  nodes_.setState(index, BackwardNodes::CLOSED);
  for (unsigned mask = nodes_.stepsFrom(index); mask != 0; mask &= mask - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(mask));
    relax(index, nodes_.along(index, step), step, counts, wait);
  }
}

template <class Bound, class Lowered>
std::uint64_t BackwardSearchTree::advance(const Bound& bound, const Lowered& lowered,
                                          std::uint64_t limit, bool record, SearchResult& result,
                                          StopPoll& poll) {
  const auto wait = [&](Index index) {
    open_.push(keys_, index);
    lowered(index);
  };
  Statistics& counts = result.statistics;
  std::uint64_t taken = 0;
  while (taken < limit) {
    poll();
    if (open_.first(bound(), keys_) == nullptr) break;
    counts.peak_open = std::max(counts.peak_open, open_.size());
    const TiledOpenList::Entry entry = open_.pop();
    if (nodes_.state(entry.index) != BackwardNodes::OPEN) continue;
    if (keys_.of(entry.index) > entry.key) {
      open_.push(keys_, entry.index);
      continue;
    }
    ++taken;
    ++counts.expanded;
    if (record) result.expanded.emplace_back(entry.index);
    expand(entry.index, counts, wait);
  }
  return taken;
}

Status BackwardSearchTree::plan(const CostGrid& map, Cell start, bool record, SearchResult& result,
                                const StopToken& stop) {
  constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();
  nodes_.setMap(map);
  const Index from = map.geometry().index(start).value();
  StopPoll poll(stop);
  keys_.move(start);
  if (lastPathHolds(map, result)) return Status::FOUND;
  const auto everything = [] { return kInfiniteKey; };
  const auto below_start = [&] {
    const bool labelled = nodes_.state(from) != BackwardNodes::UNLABELLED;
    return labelled ? keys_.withKeyModifier(nodes_.g(from)) : kInfiniteKey;
  };
  const auto below_way = [this] { return keys_.withKeyModifier(repair_search_.cost()); };
  const auto nobody = [](Index) {};
  bool concerned = false;
  const auto theDetour = [&](Index index) {
    concerned = concerned || repair_search_.affects(nodes_, index);
  };
  std::uint64_t further = kFirstFurther;
  while (true) {
    // 1. What waits behind the cost of a way cannot make it cheaper; the rest is passed on.
    advance(below_start, nobody, kUnlimited, record, result, poll);
    if (nodes_.state(from) == BackwardNodes::UNLABELLED) return unreachable();

    // 2. Around what got dearer.
    const bool found = repair_search_.run(nodes_, from, consistent_below_, record, result, poll);
    detoured_ += repair_search_.expanded();
    if (found) {
      concerned = false;
      advance(below_way, theDetour, kUnlimited, record, result, poll);
      if (concerned) continue;
      path_ = repair_search_.path(nodes_);
      path_cost_ = exactCostOf(repair_search_.cost(), kPackedScale) * map.kernel();
      result.cells = path_;
      result.cost = path_cost_;
      return Status::FOUND;
    }

    // 3. There is no way over the cells of the tree: it grows.
    overflowed_ = overflowed_ || repair_search_.overflowed();
    if (!repair_search_.leftTheTree()) return unreachable();
    if (advance(everything, nobody, further, record, result, poll) == 0) return unreachable();
    further *= 2;
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
  const CellRect dearer = around(changes.increased), cheaper = around(changes.decreased);
  const auto got_dearer = [&](Cell cell) { return dearer.contains(cell); };
  if (!cheaper.empty() || std::any_of(path_.begin(), path_.end(), got_dearer)) path_.clear();
  onCostIncrease(dearer);
  onCostDecrease(cheaper);
}

// Along a way labels fall, and it leaves the rectangle over a cell of its border: those that are
// lower than the labels there are of ways that come nowhere near.
void BackwardSearchTree::onCostIncrease(const CellRect& rect) {
  if (rect.empty()) return;
  if (rect.contains(goal_)) consistent_below_ = 0;
  const auto take = [this](int column, int row) {
    const auto index = static_cast<Index>(nodes_.geometry().index({column, row}).value());
    if (nodes_.state(index) != BackwardNodes::UNLABELLED)
      consistent_below_ = std::min(consistent_below_, nodes_.g(index));
  };
  const Cell last{rect.column + rect.width - 1, rect.row + rect.height - 1};
  for (int row = rect.row; row <= last.row; ++row) {
    take(rect.column, row);
    take(last.column, row);
  }
  for (int column = rect.column; column <= last.column; ++column) {
    take(column, rect.row);
    take(column, last.row);
  }
}

// Where a label exceeds a neighbour's and the step there, the neighbour waits from now on.
void BackwardSearchTree::onCostDecrease(const CellRect& rect) {
  if (rect.empty()) return;
  nodes_.prefetchRows(rect);
  InconsistencyScan lines(nodes_, rect);
  lines.forEachSuspect([&](Cell cell) {
    const auto index = static_cast<Index>(nodes_.geometry().index(cell).value());
    const bool east = cell.column + 1 < rect.column + rect.width;
    const bool north = cell.row + 1 < rect.row + rect.height;
    if (east) compare(index, 0);
    if (north) compare(index, 1);
    if (east && north) {
      compare(index, 4);
      compare(index + 1, 5);
    }
  });
}

void BackwardSearchTree::compare(Index index, std::uint32_t step) {
  const Index other = nodes_.along(index, step);
  const SearchKey length = nodes_.stepKey(index, other, step);
  const bool known = nodes_.state(index) != BackwardNodes::UNLABELLED;
  const bool other_known = nodes_.state(other) != BackwardNodes::UNLABELLED;
  if (known && (!other_known || nodes_.g(other) > nodes_.g(index) + length))
    markInconsistent(index, step);
  else if (other_known && (!known || nodes_.g(index) > nodes_.g(other) + length))
    markInconsistent(other, oppositeStep(step));
}

void BackwardSearchTree::markInconsistent(Index index, std::uint32_t step) {
  if (nodes_.state(index) != BackwardNodes::CLOSED || (nodes_.stepsFrom(index) >> step & 1U) == 0)
    return;
  nodes_.setState(index, BackwardNodes::OPEN);
  open_.push(keys_, index);
}

}  // namespace grid_path_planner::planners
