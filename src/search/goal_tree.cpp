#include "grid_path_planner/search/goal_tree.h"

#include <array>
#include <limits>
#include <utility>

#include "grid_path_planner/search/bucket_queue.h"

namespace grid_path_planner {
namespace {

// Labels, estimates and what keys are raised by must not overflow together.
constexpr SearchKey kLargestLabel = kLargestKey / 2;
constexpr SearchKey kLargestEstimate = kLargestKey / 4;
constexpr SearchKey kLargestRaise = kLargestKey / 4;

// What is left of the largest label fits 32 bits.
constexpr unsigned kLabelShift = 31;
static_assert(kLargestLabel >> kLabelShift < ~std::uint32_t{0});
// Half a straight step: see bucket_queue.h.
constexpr unsigned kBucketShift = 30;

// Of the buckets of what waits for repairs, times the cheapest weight.
constexpr SearchKey kQueueWidth = 2 * kStraightKey;

constexpr std::uint32_t opposite(std::uint32_t step) {
  return step ^ 2U;
}
static_assert(kSteps[opposite(0)].column == -kSteps[0].column &&
              kSteps[opposite(1)].row == -kSteps[1].row &&
              kSteps[opposite(4)].column == -kSteps[4].column &&
              kSteps[opposite(5)].column == -kSteps[5].column);

// Where in a rectangle of a map, and one cell around it, a step may have become dearer or cheaper.
class ChangesAround {
 public:
  using Kind = std::uint8_t;
  static constexpr Kind DEARER = 1, CHEAPER = 2;

  ChangesAround(const Grid<CostGrid::Weight>& before, const Grid<CostGrid::Weight>& after,
                const CellRect& changed)
      : rect_(changed.grown(1).intersection(after.geometry().rect())),
        kinds_(static_cast<std::size_t>(rect_.width) * rect_.height) {
    const CellRect inside = changed.intersection(after.geometry().rect());
    for (int row = inside.row; row < inside.row + inside.height; ++row) {
      const CostGrid::Weight* old_weights = before.row(row);
      const CostGrid::Weight* new_weights = after.row(row);
      for (int column = inside.column; column < inside.column + inside.width; ++column) {
        // Blocked is 0: one below it is dearer than anything.
        const auto was = static_cast<CostGrid::Weight>(old_weights[column] - 1);
        const auto is = static_cast<CostGrid::Weight>(new_weights[column] - 1);
        if (was != is) markAround({column, row}, is > was ? DEARER : CHEAPER);
      }
    }
  }

  template <class Visit>
  void forEach(Kind kind, const Visit& visit) const {
    std::size_t i = 0;
    for (int row = rect_.row; row < rect_.row + rect_.height; ++row)
      for (int column = rect_.column; column < rect_.column + rect_.width; ++column, ++i)
        if ((kinds_[i] & kind) != 0) visit(Cell{column, row});
  }

 private:
  void markAround(Cell cell, Kind kind) {
    const CellRect around = CellRect{cell.column, cell.row, 1, 1}.grown(1).intersection(rect_);
    for (int row = around.row; row < around.row + around.height; ++row)
      for (int column = around.column; column < around.column + around.width; ++column)
        kinds_[static_cast<std::size_t>(row - rect_.row) * rect_.width + column - rect_.column] |=
            kind;
  }

  CellRect rect_;
  std::vector<Kind> kinds_;
};

}  // namespace

void GoalTree::prepare(const CostGrid& map, const Moves& moves) {
  begun_ = false;
  moves_ = &moves;
  geometry_ = map.geometry();
  cell_of_ = CellOfIndex(geometry_);
  diagonal_step_ = diagonalKey(map.motion().diagonal_cost);
  if (words_.size() == geometry_.size()) return;
  labels_ = ZeroedArray<SearchKey>(geometry_.size());
  words_ = ZeroedArray<std::uint32_t>(geometry_.size());
  tree_ = 0;
}

void GoalTree::setRoot(const CostGrid& map, Cell goal) {
  if (++tree_ == std::uint32_t{1} << (32 - kTreeShift)) {
    words_.clear();
    tree_ = 1;
  }
  raised_ = 0;
  goal_ = goal;
  root_ = geometry_.index(goal).value();

  const MotionModel& motion = map.motion();
  const auto longest = static_cast<SearchKey>(geometry_.width()) + geometry_.height();
  const bool fits = longest * 2 * kStraightKey <= kLargestEstimate / map.cheapest();
  scale_ = fits ? map.cheapest() : CostGrid::kBlocked;
  straight_ = kStraightKey * scale_;
  diagonal_ = motion.connectivity == Connectivity::FOUR ? 2 * straight_ : diagonal_step_ * scale_;

  set(root_, 0, OPEN);
  labels_[root_] = 0;
}

GoalTree::Outcome GoalTree::begin(const CostGrid& map, Cell goal, Cell start, std::uint64_t ahead,
                                  bool record, PlanResult& result, const StopToken& stop) {
  weights_ = map.weights().values().data();
  begun_ = false;
  setRoot(map, goal);
  start_ = start;
  const Index from = geometry_.index(start).value();
  Statistics& counts = result.statistics;
  StopPoll poll(stop);
  BucketQueue waiting;
  waiting.begin(keyOf(root_), kBucketShift);
  const auto wait = [&](Index index) { waiting.push(keyOf(index), index); };
  wait(root_);

  // 1. Until nothing that waits can make the way from the start cheaper; 2. and some more.
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
  bool found = false;
  while (!waiting.empty() && counts.expanded < limit) {
    poll();
    counts.peak_open = std::max(counts.peak_open, waiting.size());
    if (!found && state(from) != UNLABELLED && waiting.lowest() >= labels_[from]) {
      found = true;
      limit = counts.expanded * (1 + ahead);
    }
    const Index index = waiting.pop();
    if (state(index) != OPEN) continue;
    ++counts.expanded;
    if (record) result.expanded.emplace_back(index);
    expand(index, counts, wait);
  }

  // 3. What still waits does so for repairs.
  new_doubts_.clear();
  queue_.begin(labels_[from], kQueueWidth * std::max<SearchKey>(scale_, 1));
  while (!waiting.empty()) {
    const Index index = waiting.pop();
    if (state(index) == OPEN) push(index);
  }
  begun_ = true;
  if (state(from) == UNLABELLED) return Outcome::UNREACHABLE;
  trace(from);
  return finish(map, result);
}

GoalTree::Outcome GoalTree::finish(const CostGrid& map, PlanResult& result) const {
  result.cells = path_;
  result.cost = costOfSteps(map, path_);
  return Outcome::FOUND;
}

bool GoalTree::serves(const CostGrid& map, Cell goal) const {
  return begun_ && goal_ == goal && scale_ <= map.cheapest() && raised_ <= kLargestRaise;
}

void GoalTree::push(Index index) {
  const std::uint32_t order = state(index) == DOUBTFUL
                                  ? kDoubtFirst
                                  : static_cast<std::uint32_t>(labels_[index] >> kLabelShift);
  queue_.push({keyOf(index), order, index});
}

bool GoalTree::renew(PatientQueue::Entry& entry) const {
  const State is = state(entry.index);
  if (is != OPEN && is != DOUBTFUL) return false;
  const SearchKey key = keyOf(entry.index);
  if (key < entry.key) return false;  // another entry came with the lower key
  entry.key = key;
  return true;
}

void GoalTree::moveStart(Cell start) {
  raised_ += estimate(start_, start);
  start_ = start;
}

void GoalTree::doubt(Index index) {
  setState(index, DOUBTFUL);
  push(index);
}

template <class Wait>
void GoalTree::relax(Index from, Index to, std::uint32_t step, Statistics& counts,
                     const Wait& wait) {
  const SearchKey label = labels_[from] + stepKey(from, to, step);
  const State is = state(to);
  if (is != UNLABELLED && (labels_[to] < label || (labels_[to] == label && is != DOUBTFUL))) return;
  if (label > kLargestLabel) throw CostOverflow();
  if (is == CLOSED) ++counts.reopened;
  labels_[to] = label;
  set(to, opposite(step), OPEN);
  wait(to);
  ++counts.generated;
}

template <class Wait>
void GoalTree::expand(Index index, Statistics& counts, const Wait& wait) {
  setState(index, CLOSED);
  for (unsigned mask = moves_->from(index); mask != 0; mask &= mask - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(mask));
    relax(index, along(index, step), step, counts, wait);
  }
}

GoalTree::Offered GoalTree::offeredTo(Index doubtful) {
  Offered best;
  following_ = 0;
  for (unsigned mask = moves_->from(doubtful); mask != 0; mask &= mask - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(mask));
    const Index next = along(doubtful, step);
    const State is = state(next);
    if (is == UNLABELLED || is == DOUBTFUL) continue;
    if (stepOf(next) == opposite(step) && next != root_) {
      followers_[following_++] = next;
      continue;
    }
    if (is != CLOSED) continue;
    const SearchKey label = labels_[next] + stepKey(doubtful, next, step);
    if (label < best.label) best = {label, step};
  }
  return best;
}

void GoalTree::open(Index index, const Offered& way, Statistics& counts) {
  if (way.label == kInfiniteKey) return;
  if (way.label > kLargestLabel) throw CostOverflow();
  labels_[index] = way.label;
  set(index, way.step, OPEN);
  push(index);
  ++counts.generated;
}

void GoalTree::settle(Index doubtful, Statistics& counts) {
  const Offered best = offeredTo(doubtful);
  if (best.label <= labels_[doubtful]) {  // nobody else need doubt
    labels_[doubtful] = best.label;
    set(doubtful, best.step, OPEN);
    return expand(doubtful, counts, [this](Index index) { push(index); });
  }
  for (std::size_t i = 0; i < following_; ++i) doubt(followers_[i]);
  set(doubtful, 0, UNLABELLED);
  open(doubtful, best, counts);
}

std::uint64_t GoalTree::sweep(SearchKey bound, std::uint64_t limit, bool record, PlanResult& result,
                              StopPoll& poll) {
  const auto collect = [&](Index index) {
    setState(index, DOUBTFUL);
    if (keyOf(index) > bound) return push(index);
    doubts_.push_back({labels_[index], index});
    std::push_heap(doubts_.begin(), doubts_.end());
  };
  for (const Index index : new_doubts_)
    if (state(index) == DOUBTFUL) collect(index);
  new_doubts_.clear();

  // 1. Nobody doubts in vain: what is taken has the least label, so those it may follow are sure.
  std::uint64_t taken = 0;
  while (!doubts_.empty() && taken < limit && poll.ask() == StopReason::NONE) {
    std::pop_heap(doubts_.begin(), doubts_.end());
    const Index index = doubts_.back().index;
    doubts_.pop_back();
    if (state(index) != DOUBTFUL) continue;
    ++taken;
    ++result.statistics.expanded;
    if (record) result.expanded.emplace_back(index);
    const Offered best = offeredTo(index);
    if (best.label <= labels_[index]) {
      labels_[index] = best.label;
      set(index, best.step, OPEN);
      expand(index, result.statistics, [this](Index opened) { push(opened); });
      continue;
    }
    for (std::size_t i = 0; i < following_; ++i) collect(followers_[i]);
    set(index, 0, UNLABELLED);
    swept_.push_back(index);
  }
  for (const Doubt& left : doubts_)
    if (state(left.index) == DOUBTFUL) push(left.index);
  doubts_.clear();

  // 2. What is sure now is offered to those who have no way, or took another meanwhile.
  for (const Index index : swept_) {
    const Offered best = offeredTo(index);
    if (state(index) == UNLABELLED || best.label < labels_[index])
      open(index, best, result.statistics);
  }
  swept_.clear();
  return taken;
}

std::optional<GoalTree::Index> GoalTree::trace(Index start) {
  path_.clear();
  for (Index at = start;; at = along(at, stepOf(at))) {
    if (state(at) == DOUBTFUL) return at;
    path_.push_back(cell_of_(at));
    if (at == root_) return std::nullopt;
  }
}

void GoalTree::take(Index index, bool record, PlanResult& result) {
  ++result.statistics.expanded;
  if (record) result.expanded.emplace_back(index);
  if (state(index) == DOUBTFUL)
    settle(index, result.statistics);
  else
    expand(index, result.statistics, [this](Index opened) { push(opened); });
}

GoalTree::Outcome GoalTree::repair(const CostGrid& map, Cell start, std::uint64_t limit,
                                   bool record, PlanResult& result, const StopToken& stop) {
  weights_ = map.weights().values().data();
  const Index from = geometry_.index(start).value();
  StopPoll poll(stop);
  moveStart(start);
  const auto renewed = [this](PatientQueue::Entry& entry) { return renew(entry); };
  const SearchKey before = state(from) == UNLABELLED ? 0 : labels_[from] + raised_;
  for (std::uint64_t taken = sweep(before, limit, record, result, poll);; ++taken) {
    poll();
    // 1. What waits behind the cost of the way found cannot make it cheaper.
    const State is = state(from);
    const bool found = is == OPEN || is == CLOSED;
    const SearchKey bound = found ? labels_[from] + raised_ : kInfiniteKey;
    const PatientQueue::Entry* next = queue_.first(bound, renewed);
    if (found && (next == nullptr || (next->key == bound && next->order != kDoubtFirst))) {
      const std::optional<Index> doubtful = trace(from);
      if (!doubtful) return finish(map, result);
      if (taken >= limit) return Outcome::LIMIT;
      take(*doubtful, record, result);
      continue;
    }
    if (next == nullptr) return Outcome::UNREACHABLE;
    if (taken >= limit) return Outcome::LIMIT;

    // 2. The most promising cell, unless the entry is out of date.
    result.statistics.peak_open = std::max(result.statistics.peak_open, queue_.size());
    const PatientQueue::Entry old = queue_.pop();
    PatientQueue::Entry entry = old;
    if (!renew(entry)) continue;
    if (entry.key > old.key)
      queue_.push(entry);
    else
      take(entry.index, record, result);
  }
}

void GoalTree::checkWayOf(Index index) {
  const State is = state(index);
  if (is == UNLABELLED || index == root_) return;
  const std::uint32_t step = stepOf(index);
  if (weights_[index] == CostGrid::kBlocked) return set(index, 0, UNLABELLED);
  if (is == DOUBTFUL) return;
  const Index next = along(index, step);
  if ((moves_->from(index) >> step & 1U) != 0 &&
      labels_[index] >= labels_[next] + stepKey(index, next, step))
    return;
  setState(index, DOUBTFUL);
  new_doubts_.push_back(index);
}

void GoalTree::update(const CostGrid& before, const CostGrid& after, const CellRect& changed) {
  if (!begun_) return;
  weights_ = after.weights().values().data();
  const ChangesAround changes(before.weights(), after.weights(), changed);
  Statistics counts;
  const auto wait = [this](Index index) { push(index); };
  changes.forEach(ChangesAround::DEARER,
                  [&](Cell cell) { checkWayOf(geometry_.index(cell).value()); });
  changes.forEach(ChangesAround::CHEAPER, [&](Cell cell) {
    const Index index = geometry_.index(cell).value();
    if (state(index) == CLOSED) expand(index, counts, wait);
  });
}

}  // namespace grid_path_planner
