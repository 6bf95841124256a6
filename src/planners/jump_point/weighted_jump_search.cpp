#include "planners/jump_point/weighted_jump_search.h"

#include <algorithm>
#include <utility>

#include "planners/core/keys.h"
#include "planners/core/steps.h"

namespace grid_path_planner::planners {

using base::Statistics, base::Status, base::Stopped, base::StopPoll, base::StopReason,
    base::StopToken, base::ZeroedArray;
using costmap::CostGrid, costmap::ExactCost, costmap::stepAllowed;
using grid::Cell, grid::CellIndex, grid::CellRect;

namespace {

// An expansion may jump across the map.
constexpr std::uint32_t kExpansionsBetweenPolls = 64;

// By how much, in cell lengths at the least weight, the f-value of a diagonal jump may exceed that
// of its first cell before the jump is put into the open list. Low: many pushes; high: jumps where
// the search would never come. From 8 to 100 hardly matters.
constexpr std::uint64_t kDiagonalSlack = 16;
// The same with the bound of the blocks, where cells weigh several times the least.
constexpr std::uint64_t kDiagonalSlackWithBound = 48;

// Buckets of about a quarter of the least cost of a step.
constexpr unsigned kBucketsPerStep = 4;

Cell moved(Cell cell, unsigned step) {
  return {cell.column + kSteps[step].column, cell.row + kSteps[step].row};
}

}  // namespace

void WeightedJumpSearch::prepare(const CostGrid& map, const StopToken& stop, int block) {
  blocks_.setSide(block);
  blocks_.prepare(map, stop);
  sample_.clear();
  jumps_.reset(map);
  if (g_.size() == map.geometry().size()) return;
  g_ = ZeroedArray<StampedG>(map.geometry().size());
  g_is_mapped_ = false;
  stamp_.restart();
}

void WeightedJumpSearch::finish(const CostGrid& map, const StopToken& stop) {
  jumps_.makeAllReady(map, stop);
  if (g_is_mapped_) return;
  constexpr std::size_t kPage = 4096 / sizeof(StampedG);
  StopPoll poll(stop, kExpansionsBetweenPolls);
  for (std::size_t at = 0; at < g_.size(); at += kPage) {
    poll();
    g_[at] = 0;  // of no query
  }
  g_is_mapped_ = true;
}

void WeightedJumpSearch::update(const CostGrid& map, const std::vector<CellRect>& changed,
                                const StopToken& stop, int block) {
  sample_.clear();
  if (block == blocks_.side()) {
    blocks_.update(map, changed);
  } else {
    blocks_.setSide(block);
    blocks_.prepare(map, StopToken());
  }
  jumps_.update(map, changed, stop);
}

void WeightedJumpSearch::release() {
  jumps_ = WeightedJumpMap();
  blocks_.release();
  g_ = ZeroedArray<StampedG>();
}

SearchResult WeightedJumpSearch::run(const CostGrid& map, const SearchRequest& request,
                                     const StopToken& stop, std::uint64_t most_tiles,
                                     std::optional<LandmarkBound> landmarks) {
  found_ = false;  // the tiles around the goal may be too many
  landmarks_.reset();
  if (landmarks) landmarks_.emplace(*std::move(landmarks));
  const WeightedJumpMap::ScopedLimit scoped_limit(jumps_, stop, most_tiles);
  const WeightedJumpMap::ScopedGoal scoped_goal(jumps_, map, request.goals.front());
  startQuery(map, request);
  return search(request, stop);
}

void WeightedJumpSearch::startQuery(const CostGrid& map, const SearchRequest& request) {
  stamp_.next([this] { g_.clear(); });
  map_ = &map;
  weights_ = map.weights().values().data();
  width_ = std::uint32_t(map.geometry().width());
  start_ = request.start;
  sample_.clear();
  sampled_each_ = kFirstSampledEach;
  goal_ = request.goals.front();
  goal_index_ = indexOf(goal_);
  straight_ = map.minWeight() * kStraight;
  saving_ = map.minWeight() * (2 * kStraight - kDiagonal);
  zero_g_ = stamp_.word() | kLargest;
  most_ = kLargest;
  goal_reached_ = found_ = too_expensive_ = false;
  counts_ = Statistics();
  bound_.reset();
  slack_ = (landmarks_ ? kDiagonalSlackWithBound : kDiagonalSlack) * straight_;
  bucket_shift_ = 63U - unsigned(__builtin_clzll(straight_ / kBucketsPerStep));
  open_.reset(estimate(request.start), bucket_shift_);
}

SearchResult WeightedJumpSearch::search(const SearchRequest& request, const StopToken& stop) {
  SearchResult result;
  StopPoll poll(stop, kExpansionsBetweenPolls);
  if (landmarks_ && landmarks_->separates(indexOf(request.start)))
    return withStatus(Status::UNREACHABLE, std::move(result));
  if (request.record_expanded) result.expanded.emplace_back(indexOf(request.start));
  expandStart(request.start);
  while (!open_.empty() && open_.lowest() < most_) {
    const StopReason reason = poll.ask();
    if (reason != StopReason::NONE) return withStatus(Stopped(reason).status(), std::move(result));
    counts_.peak_open = std::max(counts_.peak_open, open_.size());
    if (needsBound() && !makeBound(request, stop)) break;
    const std::uint32_t index = open_.pop();
    const WeightedJumpMap::Mark& mark = jumps_.mark(index);
    if (mark.reached == mark.expanded) continue;  // a duplicate
    const Cell cell = map_->geometry().cell(CellIndex(index));
    const Key g = gOf(index);
    if (goal_reached_ && g + estimate(cell) >= most_) continue;
    if (request.record_expanded) result.expanded.emplace_back(index);
    sample(index);
    expand(index, cell, g);
  }
  if (!goal_reached_ && too_expensive_) throw TooExpensive();
  if (!goal_reached_) return withStatus(Status::UNREACHABLE, std::move(result));
  trace(request.start, result);
  found_ = true;
  return withStatus(Status::FOUND, std::move(result));
}

// The open cells are ordered anew. Returns false where the bound tells that no path leads to the
// goal.
bool WeightedJumpSearch::makeBound(const SearchRequest& request, const StopToken& stop) {
  bound_.emplace(blocks_.to(goal_), kMediumScale, stop);
  const Key first = (*bound_)(request.start);
  if (first == kInfiniteKey) return false;
  std::vector<std::uint32_t> cells;
  while (!open_.empty()) cells.push_back(open_.pop());
  open_.reset(first, bucket_shift_);
  for (const std::uint32_t index : cells)
    open_.push(gOf(index) + estimate(map_->geometry().cell(CellIndex(index))), index);
  slack_ = kDiagonalSlackWithBound * straight_;
  return true;
}

// Every second one stays, so that the sample of a long search is spread over it, too.
void WeightedJumpSearch::thinSample() {
  for (std::size_t i = 0; 2 * i < sample_.size(); ++i) sample_[i] = sample_[2 * i];
  sample_.resize((sample_.size() + 1) / 2);
  sampled_each_ *= 2;
}

std::optional<BoundChoice::Evidence> WeightedJumpSearch::evidence(const StopToken& stop) {
  const bool enough = counts_.expanded >= kLeastWeighed && !sample_.empty();
  if (bound_ || landmarks_ || !found_ || !enough) return std::nullopt;
  BlockBound& bound = blocks_.to(goal_);
  const BlockEstimate blocks(bound, kMediumScale, stop);
  if (blocks(start_) == kInfiniteKey) return std::nullopt;
  std::size_t spared = 0;
  for (const std::uint32_t index : sample_)
    if (gOf(index) + blocks.known({int(index % width_), int(index / width_)}) >= most_) ++spared;
  return BoundChoice::Evidence{counts_.expanded, double(spared) / double(sample_.size()),
                               bound.expanded()};
}

void WeightedJumpSearch::expandStart(Cell start) {
  const std::uint32_t index = indexOf(start);
  jumps_.makeReady(*map_, start);
  relax(index, 0);
  ++counts_.expanded;
  if (index == goal_index_) {
    goal_reached_ = true;
    return;
  }
  unsigned steps = 0;
  for (unsigned step = 0; step < 8; ++step)
    if (stepAllowed(*map_, start, moved(start, step))) steps |= 1U << step;
  jumpBy(steps, index, start, 0);
}

void WeightedJumpSearch::expand(std::uint32_t index, Cell cell, Key g) {
  WeightedJumpMap::Mark& mark = jumps_.mark(index);
  const NaturalMoves steps = jumps_.steps(*map_, index);
  const unsigned fresh = naturalAfter(steps, mark.reached) & ~naturalAfter(steps, mark.expanded);
  mark.expanded = mark.reached;
  ++counts_.expanded;
  jumpBy(fresh, index, cell, g);
}

void WeightedJumpSearch::jumpBy(unsigned steps, std::uint32_t index, Cell cell, Key g) {
  if ((steps & 1U) != 0) jumpStraight<0>(cell, g);
  if ((steps & 2U) != 0) jumpStraight<1>(cell, g);
  if ((steps & 4U) != 0) jumpStraight<2>(cell, g);
  if ((steps & 8U) != 0) jumpStraight<3>(cell, g);
  if ((steps & 240U) == 0) return;
  const Key limit = g + estimate(cell) + slack_;
  if ((steps & 16U) != 0) jumpDiagonally<4>(index, cell, g, limit);
  if ((steps & 32U) != 0) jumpDiagonally<5>(index, cell, g, limit);
  if ((steps & 64U) != 0) jumpDiagonally<6>(index, cell, g, limit);
  if ((steps & 128U) != 0) jumpDiagonally<7>(index, cell, g, limit);
}

// Whether a path of cost f or more is of no use.
inline bool WeightedJumpSearch::beyondMost(Key f) {
  if (f < most_) return false;
  too_expensive_ =
      true;  // read only if the goal was not reached: before, the bound is that of the keys
  return true;
}

template <unsigned kStep>
void WeightedJumpSearch::jumpStraight(Cell cell, Key g) {
  if (jumps_.deadEnd<kStep>(*map_, cell)) return;
  const WeightedJumpMap::Jump jump = jumps_.straightJump<kStep>(cell, weights_);
  g += jump.weights * kStraight;
  const std::uint32_t index = indexOf(jump.to);
  if (beyondMost(g) || hasLessThan(index, g)) return;
  const Key f = g + estimate(jump.to);
  if (beyondMost(f)) return;
  relax(index, g);
  reach(index, jumps_.steps(*map_, index), kStep, f);
}

// Up to the f-value `limit`. Open cells whose two straight jumps are dead ends get no g-value.
template <unsigned kStep>
void WeightedJumpSearch::jumpDiagonally(std::uint32_t index, Cell cell, Key g, Key limit) {
  constexpr unsigned kStepBit = 1U << kStep;
  constexpr unsigned kRowStep = kStep == 4 || kStep == 7 ? 0 : 2;  // its straight parts
  constexpr unsigned kColumnStep = kStep == 4 || kStep == 5 ? 1 : 3;
  static_assert(kNaturalInTheOpen[kStep] == (kStepBit | 1U << kRowStep | 1U << kColumnStep));
  const std::uint32_t offset =
      static_cast<std::uint32_t>(kSteps[kStep].row) * width_ + std::uint32_t(kSteps[kStep].column);
  Key weight = weights_[index];
  for (;;) {
    index += offset;
    cell = moved(cell, kStep);
    bool open = jumps_.open(cell);
    if (__builtin_expect(!open && !jumps_.ready(index), 0)) {
      jumps_.makeReady(*map_, cell);
      open = jumps_.open(cell);
    }
    if (open) {
      g += kDiagonal * weight;
      if (jumps_.deadEnd<kRowStep>(*map_, cell) && jumps_.deadEnd<kColumnStep>(*map_, cell))
        continue;
    } else {
      const Key next = weights_[index];
      g += kDiagonal * std::max(weight, next);
      weight = next;
    }
    const NaturalMoves steps = jumps_.steps(*map_, index);
    const unsigned after = steps >> (8 * kStep) & 255U;
    if (after == 0 && index != goal_index_) return;
    if (beyondMost(g) || hasLessThan(index, g)) return;
    const Key f = g + estimate(cell);
    if (beyondMost(f)) return;
    relax(index, g);
    WeightedJumpMap::Mark& mark = jumps_.mark(index);
    if ((mark.reached & kStepBit) != 0) return;
    const bool turns = (after & ~unsigned(kNaturalInTheOpen[kStep])) != 0;
    if (turns || f > limit || index == goal_index_) return reach(index, steps, kStep, f);
    const unsigned fresh = mark.expanded == 0 ? after : after & ~naturalAfter(steps, mark.expanded);
    mark.reached |= static_cast<std::uint8_t>(kStepBit);
    mark.expanded |= static_cast<std::uint8_t>(kStepBit);
    if ((fresh >> kRowStep & 1U) != 0) jumpStraight<kRowStep>(cell, g);
    if ((fresh >> kColumnStep & 1U) != 0) jumpStraight<kColumnStep>(cell, g);
    if ((fresh & kStepBit) == 0) return;
  }
}

// Lowers the cell's g-value to g, and then forgets the steps that reached it before. Precondition:
// the cell has no lower one.
inline void WeightedJumpSearch::relax(std::uint32_t index, Key g) {
  const StampedG stamped = zero_g_ - g;
  if (stamped == g_[index]) return;
  g_[index] = stamped;
  WeightedJumpMap::Mark& mark = jumps_.mark(index);
  mark.reached = mark.expanded = 0;
}

// A jump by `step` ended at the cell, whose g-value is up to date. Pushes the cell if a step of
// `steps` becomes natural by that.
void WeightedJumpSearch::reach(std::uint32_t index, NaturalMoves steps, unsigned step, Key f) {
  if (index == goal_index_) {
    goal_reached_ = true;
    most_ = f;
  }
  WeightedJumpMap::Mark& mark = jumps_.mark(index);
  const bool in_open_list = mark.reached != mark.expanded;
  unsigned fresh = steps >> (8 * step) & 255U;
  if (mark.reached != 0) fresh &= ~naturalAfter(steps, mark.reached);
  mark.reached |= static_cast<std::uint8_t>(1U << step);
  if (in_open_list) return;
  if (fresh == 0) {
    mark.expanded = mark.reached;
    return;
  }
  if (f >= most_) return;
  if (mark.expanded != 0) ++counts_.reopened;
  open_.push(f, index);
  ++counts_.generated;
}

// The octile distance at the least weight.
inline WeightedJumpSearch::Key WeightedJumpSearch::octile(Cell cell) const {
  const auto columns = std::uint32_t(std::abs(cell.column - goal_.column));
  const auto rows = std::uint32_t(std::abs(cell.row - goal_.row));
  return (columns + rows) * straight_ - std::min(columns, rows) * saving_;
}

// No more than keys hold: cells from which no landmark knows a path are beyond all paths.
WeightedJumpSearch::Key WeightedJumpSearch::byLandmarks(Cell cell) const {
  return std::min(kLargest, std::max((*landmarks_)(indexOf(cell)), octile(cell)));
}

// From the goal back, at every cell against a step that reached it.
void WeightedJumpSearch::trace(Cell start, SearchResult& result) const {
  std::vector<Cell>& cells = result.cells;
  cells = {goal_};
  while (cells.back() != start) {
    const auto step = unsigned(__builtin_ctz(jumps_.mark(indexOf(cells.back())).reached));
    const Cell from = predecessorOf(cells.back(), step);
    std::int64_t weights = 0;
    while (cells.back() != from) {
      const Cell at = cells.back();
      cells.push_back({at.column - kSteps[step].column, at.row - kSteps[step].row});
      weights += std::max(map_->weight(at), map_->weight(cells.back()));
    }
    result.cost += (step < 4 ? ExactCost{weights, 0} : ExactCost{0, weights}) * map_->kernel();
  }
  std::reverse(cells.begin(), cells.end());
}

// The nearest cell against the step whose g-value plus the cost from there is the cell's g-value.
Cell WeightedJumpSearch::predecessorOf(Cell cell, unsigned step) const {
  const Key length = step < 4 ? kStraight : kDiagonal;
  const Key cost = gOf(indexOf(cell));
  Key from_there = 0;
  for (Cell at = cell;;) {
    const Cell before{at.column - kSteps[step].column, at.row - kSteps[step].row};
    from_there += length * std::max(map_->weight(at), map_->weight(before));
    at = before;
    const std::uint32_t index = indexOf(at);
    if (hasG(index) && gOf(index) + from_there == cost) return at;
  }
}

SearchResult WeightedJumpSearch::withStatus(Status status, SearchResult result) const {
  result.status = status;
  result.statistics = counts_;
  result.statistics.search_bytes =
      bytesFor(map_->geometry()) + counts_.peak_open * sizeof(BucketQueue::Index);
  return result;
}

}  // namespace grid_path_planner::planners
