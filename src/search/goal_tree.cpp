#include "grid_path_planner/search/goal_tree.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "grid_path_planner/search/bucket_queue.h"
#include "label_lines.h"
#include "weight_changes.h"

namespace grid_path_planner {
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

void GoalTree::prepare(const CostGrid& map, const Moves& moves) {
  begun_ = false;
  labels_.prepare(map, moves);
  detour_.prepare(map);
  waiting_.prepare(map.geometry());
}

void GoalTree::setRoot(const CostGrid& map, Cell goal, Cell start) {
  too_dear_ = false;
  sound_below_ = kInfiniteKey;
  goal_ = goal;
  labels_.begin(map.geometry().index(goal).value());
  keys_.begin(labels_, map, start);
}

Status GoalTree::begin(const CostGrid& map, Cell goal, Cell start, double ahead, bool record,
                       PlanResult& result, const StopToken& stop) {
  begun_ = false;
  way_.clear();
  labels_.look(map);
  setRoot(map, goal, start);
  const Index from = map.geometry().index(start).value();
  Statistics& counts = result.statistics;
  StopPoll poll(stop);
  BucketQueue open;
  open.begin(keys_.of(labels_.root()), kBucketShift);
  const auto wait = [&](Index index) { open.push(keys_.of(index), index); };
  wait(labels_.root());

  // 1. Until nothing that waits can make the way from the start cheaper; 2. and some more.
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
  bool found = false;
  while (!open.empty() && counts.expanded < limit) {
    poll();
    counts.peak_open = std::max(counts.peak_open, open.size());
    if (!found && labels_.state(from) != GoalLabels::UNLABELLED &&
        open.lowest() >= labels_.label(from)) {
      found = true;
      limit = counts.expanded +
              static_cast<std::uint64_t>(ahead * static_cast<double>(counts.expanded));
    }
    const Index index = open.pop();
    if (labels_.state(index) != GoalLabels::OPEN) continue;
    ++counts.expanded;
    if (record) result.expanded.emplace_back(index);
    expand(index, counts, wait);
  }

  expanded_ = counts.expanded;
  detoured_ = 0;

  // 3. What still waits does so for later plans.
  const bool reached = labels_.state(from) != GoalLabels::UNLABELLED;
  waiting_.begin(reached ? labels_.label(from) : 0,
                 kQueueWidth * std::max<SearchKey>(keys_.scale(), 1));
  while (!open.empty()) {
    const Index index = open.pop();
    if (labels_.state(index) == GoalLabels::OPEN) waiting_.push(keys_, index);
  }
  begun_ = true;
  return plan(map, start, record, result, stop);
}

bool GoalTree::serves(const CostGrid& map, Cell goal) const {
  return begun_ && goal_ == goal && keys_.scale() <= map.cheapest() && keys_.hold() &&
         detoured_ <= kWorn * expanded_;
}

template <class Wait>
void GoalTree::relax(Index from, Index to, std::uint32_t step, Statistics& counts,
                     const Wait& wait) {
  const SearchKey label = labels_.label(from) + labels_.stepKey(from, to, step);
  const State is = labels_.state(to);
  if (is != GoalLabels::UNLABELLED && labels_.label(to) <= label) return;
  if (label > GoalLabels::kLargest) {
    too_dear_ = true;
    return;
  }
  if (is == GoalLabels::CLOSED) ++counts.reopened;
  labels_.set(to, label, oppositeStep(step), GoalLabels::OPEN);
  wait(to);
  ++counts.generated;
}

template <class Wait>
void GoalTree::expand(Index index, Statistics& counts, const Wait& wait) {
  labels_.setState(index, GoalLabels::CLOSED);
  for (unsigned mask = labels_.stepsFrom(index); mask != 0; mask &= mask - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(mask));
    relax(index, labels_.along(index, step), step, counts, wait);
  }
}

template <class Bound, class Lowered>
std::uint64_t GoalTree::advance(const Bound& bound, const Lowered& lowered, std::uint64_t limit,
                                bool record, PlanResult& result, StopPoll& poll) {
  const auto wait = [&](Index index) {
    waiting_.push(keys_, index);
    lowered(index);
  };
  Statistics& counts = result.statistics;
  std::uint64_t taken = 0;
  while (taken < limit) {
    poll();
    if (waiting_.first(bound(), keys_) == nullptr) break;
    counts.peak_open = std::max(counts.peak_open, waiting_.size());
    const WaitingCells::Entry entry = waiting_.pop();
    if (labels_.state(entry.index) != GoalLabels::OPEN) continue;
    if (keys_.of(entry.index) > entry.key) {
      waiting_.push(keys_, entry.index);
      continue;
    }
    ++taken;
    ++counts.expanded;
    if (record) result.expanded.emplace_back(entry.index);
    expand(entry.index, counts, wait);
  }
  return taken;
}

Status GoalTree::plan(const CostGrid& map, Cell start, bool record, PlanResult& result,
                      const StopToken& stop) {
  constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();
  labels_.look(map);
  const Index from = map.geometry().index(start).value();
  StopPoll poll(stop);
  keys_.move(start);
  if (keepsTheWay(map, result)) return Status::FOUND;
  const auto everything = [] { return kInfiniteKey; };
  const auto below_start = [&] {
    const bool labelled = labels_.state(from) != GoalLabels::UNLABELLED;
    return labelled ? keys_.raised(labels_.label(from)) : kInfiniteKey;
  };
  const auto below_way = [this] { return keys_.raised(detour_.cost()); };
  const auto nobody = [](Index) {};
  bool concerned = false;
  const auto theDetour = [&](Index index) {
    concerned = concerned || detour_.concerns(labels_, index);
  };
  std::uint64_t further = kFirstFurther;
  while (true) {
    // 1. What waits behind the cost of a way cannot make it cheaper; the rest is passed on.
    advance(below_start, nobody, kUnlimited, record, result, poll);
    if (labels_.state(from) == GoalLabels::UNLABELLED) return unreachable();

    // 2. Around what got dearer.
    const bool found = detour_.run(labels_, from, sound_below_, record, result, poll);
    detoured_ += detour_.expanded();
    if (found) {
      concerned = false;
      advance(below_way, theDetour, kUnlimited, record, result, poll);
      if (concerned) continue;
      way_ = detour_.way(labels_);
      way_cost_ = exactCostOf(detour_.cost()) * map.kernel();
      result.cells = way_;
      result.cost = way_cost_;
      return Status::FOUND;
    }

    // 3. There is no way over the cells of the tree: it grows.
    too_dear_ = too_dear_ || detour_.tooDear();
    if (!detour_.sawTheEnd()) return unreachable();
    if (advance(everything, nobody, further, record, result, poll) == 0) return unreachable();
    further *= 2;
  }
}

bool GoalTree::keepsTheWay(const CostGrid& map, PlanResult& result) {
  const auto at = std::find(way_.begin(), way_.end(), keys_.start());
  if (at == way_.end()) return false;
  way_cost_ = way_cost_ - costOfSteps(map, {way_.begin(), at + 1});
  way_.erase(way_.begin(), at);
  result.cells = way_;
  result.cost = way_cost_;
  return true;
}

Status GoalTree::unreachable() const {
  if (too_dear_) throw CostOverflow();
  return Status::UNREACHABLE;
}

void GoalTree::update(const CostGrid& before, const CostGrid& after, const CellRect& changed) {
  if (!begun_) return;
  labels_.look(after);
  const CellRect all = after.geometry().rect();
  const auto around = [&all](const CellRect& rect) {
    return rect.empty() ? rect : rect.grown(1).intersection(all);
  };
  const WeightChanges changes =
      changesBetween(before.weights(), after.weights(), changed.intersection(all));
  const CellRect dearer = around(changes.dearer), cheaper = around(changes.cheaper);
  const auto got_dearer = [&](Cell cell) { return dearer.contains(cell); };
  if (!cheaper.empty() || std::any_of(way_.begin(), way_.end(), got_dearer)) way_.clear();
  takeDearer(dearer);
  takeCheaper(cheaper);
}

// Along a way labels fall, and it leaves the rectangle over a cell of its border: those that are
// lower than the labels there are of ways that come nowhere near.
void GoalTree::takeDearer(const CellRect& rect) {
  if (rect.empty()) return;
  if (rect.contains(goal_)) sound_below_ = 0;
  const auto take = [this](int column, int row) {
    const auto index = static_cast<Index>(labels_.geometry().index({column, row}).value());
    if (labels_.state(index) != GoalLabels::UNLABELLED)
      sound_below_ = std::min(sound_below_, labels_.label(index));
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
void GoalTree::takeCheaper(const CellRect& rect) {
  if (rect.empty()) return;
  labels_.touch(rect);
  LabelLines lines(labels_, rect);
  lines.forEachSuspect([&](Cell cell) {
    const auto index = static_cast<Index>(labels_.geometry().index(cell).value());
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

void GoalTree::compare(Index index, std::uint32_t step) {
  const Index other = labels_.along(index, step);
  const SearchKey length = labels_.stepKey(index, other, step);
  const bool known = labels_.state(index) != GoalLabels::UNLABELLED;
  const bool other_known = labels_.state(other) != GoalLabels::UNLABELLED;
  if (known && (!other_known || labels_.label(other) > labels_.label(index) + length))
    wake(index, step);
  else if (other_known && (!known || labels_.label(index) > labels_.label(other) + length))
    wake(other, oppositeStep(step));
}

void GoalTree::wake(Index index, std::uint32_t step) {
  if (labels_.state(index) != GoalLabels::CLOSED || (labels_.stepsFrom(index) >> step & 1U) == 0)
    return;
  labels_.setState(index, GoalLabels::OPEN);
  waiting_.push(keys_, index);
}

}  // namespace grid_path_planner
