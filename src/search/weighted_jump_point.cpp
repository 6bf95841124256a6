#include "grid_path_planner/search/weighted_jump_point.h"

#include <algorithm>
#include <utility>

#include "grid_path_planner/search/steps.h"

namespace grid_path_planner {
namespace {

// An expansion may run across the map.
constexpr std::uint32_t kExpansionsBetweenPolls = 64;

Traits weightedJumpPointTraits() {
  Traits traits;
  traits.name = "weighted_jump_point";
  traits.optimal = true;
  traits.repairs = true;
  return traits;
}

// The best of the bounds that hold for a motion model.
SearchOptions optionsFor(const MotionModel& motion) {
  SearchOptions options;
  if (motion.connectivity == Connectivity::FOUR)
    options.heuristic = Heuristic::MANHATTAN;
  else if (motion.diagonal_cost == DiagonalCost::UNIT)
    options.heuristic = Heuristic::CHEBYSHEV;
  return options;
}

Cell moved(Cell cell, unsigned step, int times = 1) {
  return {cell.column + times * kSteps[step].column, cell.row + times * kSteps[step].row};
}

}  // namespace

WeightedJumpPoint::WeightedJumpPoint() : Planner(weightedJumpPointTraits()) {}

std::size_t WeightedJumpPoint::bytesFor(const GridGeometry& geometry) const {
  return JumpMap::bytesFor(geometry) + geometry.size() * (sizeof(Label) + sizeof(Sides));
}

bool WeightedJumpPoint::leftToAStar() const {
  return !(map().motion() == MotionModel());
}

void WeightedJumpPoint::prepareAStar(const StopToken& stop) {
  auto a_star = std::make_unique<AStar>(optionsFor(map().motion()));
  a_star->prepare(sharedMap(), stop);
  a_star_ = std::move(a_star);
}

void WeightedJumpPoint::doPrepare(const StopToken& stop) {
  a_star_.reset();
  if (leftToAStar()) {
    prepareAStar(stop);
    return;
  }
  jumps_.build(map(), stop);
  if (labels_.size() == map().geometry().size()) return;
  labels_ = ZeroedArray<Label>(map().geometry().size());
  sides_ = ZeroedArray<Sides>(map().geometry().size());
  query_ = 0;
}

void WeightedJumpPoint::doUpdate(const CellRect& changed, const StopToken& stop) {
  if (a_star_) a_star_->update(sharedMap(), changed, stop);
  if (!leftToAStar()) jumps_.update(map(), changed, stop);
}

PlanResult WeightedJumpPoint::doPlan(const PlanRequest& request, const StopToken& stop) {
  if (leftToAStar()) return a_star_->plan(request, stop);
  try {
    const JumpMap::Target target(jumps_, request.goals.front());
    return search(request, stop);
  } catch (const TooDear&) {
    if (!a_star_) prepareAStar(stop);
    return a_star_->plan(request, stop);
  }
}

void WeightedJumpPoint::beginQuery(const PlanRequest& request) {
  heap_.clear();
  if (query_ == (std::uint64_t{1} << (64 - kKeyBits)) - 1) {
    labels_.clear();
    query_ = 0;
  }
  ++query_;
  goal_ = request.goals.front();
  goal_index_ = map().geometry().index(goal_).value();
  goal_cost_ = kInfiniteKey;
  counts_ = Statistics();
}

PlanResult WeightedJumpPoint::search(const PlanRequest& request, const StopToken& stop) {
  PlanResult result;
  StopPoll poll(stop, kExpansionsBetweenPolls);
  beginQuery(request);
  if (request.record_expanded) result.expanded.push_back(map().geometry().index(request.start));
  expandStart(request.start);
  while (!heap_.empty() && heap_.front().f < goal_cost_) {
    const StopReason reason = poll.ask();
    if (reason != StopReason::NONE) return withStatus(Stopped(reason).status(), std::move(result));
    counts_.peak_open = std::max(counts_.peak_open, heap_.size());
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    const std::uint32_t index = heap_.back().index;
    heap_.pop_back();
    if (sides_[index].reached == sides_[index].expanded) continue;
    if (request.record_expanded) result.expanded.emplace_back(index);
    expand(index);
  }
  if (goal_cost_ == kInfiniteKey) return withStatus(Status::UNREACHABLE, std::move(result));
  result.cells = pathTo(request.start, goal_);
  result.cost = costOfSteps(map(), result.cells);
  return withStatus(Status::FOUND, std::move(result));
}

void WeightedJumpPoint::expandStart(Cell start) {
  const std::uint32_t index = map().geometry().index(start).value();
  improve(index, 0);
  if (index == goal_index_) goal_cost_ = 0;
  unsigned steps = 0;
  for (unsigned step = 0; step < 8; ++step)
    if (stepAllowed(map(), start, moved(start, step))) steps |= 1U << step;
  ++counts_.expanded;
  if (goal_cost_ > 0) take(steps, index, start, 0);
}

void WeightedJumpPoint::expand(std::uint32_t index) {
  Sides& sides = sides_[index];
  const NaturalSteps natural = jumps_.natural(map(), index);
  const unsigned steps = stepsAfter(natural, sides.reached) & ~stepsAfter(natural, sides.expanded);
  sides.expanded = sides.reached;
  ++counts_.expanded;
  take(steps, index, map().geometry().cell(CellIndex(index)), costOf(index));
}

void WeightedJumpPoint::take(unsigned steps, std::uint32_t index, Cell cell, Key g) {
  for (; steps != 0; steps &= steps - 1) {
    const auto step = unsigned(__builtin_ctz(steps));
    if (step < 4)
      runStraight(step, cell, g);
    else
      runDiagonally(step, index, cell, g);
  }
}

void WeightedJumpPoint::runStraight(unsigned step, Cell cell, Key g) {
  const CostGrid::Weight* weights = map().weights().values().data();
  JumpMap::Run run{};
  switch (step) {
    case 0:
      run = jumps_.alongRow<true>(cell, weights);
      break;
    case 1:
      run = jumps_.alongColumn<true>(cell, weights);
      break;
    case 2:
      run = jumps_.alongRow<false>(cell, weights);
      break;
    default:
      run = jumps_.alongColumn<false>(cell, weights);
  }
  const Cell to = (step & 1U) == 0 ? Cell{int(run.to), cell.row} : Cell{cell.column, int(run.to)};
  reach(map().geometry().index(to).value(), to, g + run.weights * kStraight, step);
}

// A run that stopped at a cell.
void WeightedJumpPoint::reach(std::uint32_t index, Cell cell, Key g, unsigned step) {
  const unsigned steps = jumps_.natural(map(), index) >> (8 * step) & 255U;
  if (steps == 0 && index != goal_index_) return;
  if (!improve(index, g)) return;
  if (index == goal_index_) goal_cost_ = g;
  Sides& sides = sides_[index];
  const unsigned side = 1U << step;
  if ((sides.reached & side) != 0) return;
  const NaturalSteps natural = jumps_.natural(map(), index);
  const unsigned known = stepsAfter(natural, sides.reached);
  const bool queued = sides.reached != sides.expanded;
  if (sides.expanded != 0) ++counts_.reopened;
  sides.reached |= std::uint8_t(side);
  if ((steps & ~known) == 0) {
    if (!queued) sides.expanded = sides.reached;
    return;
  }
  if (!queued) queue(index, cell, g);
}

// Whether g is no worse than what the cell has; a better one starts afresh. Throws TooDear.
bool WeightedJumpPoint::improve(std::uint32_t index, Key g) {
  if (g > kLargest) throw TooDear();
  const Label label = query_ << kKeyBits | (kLargest - g);
  if (label < labels_[index]) return false;
  if (label > labels_[index]) {
    labels_[index] = label;
    sides_[index] = {0, 0};
  }
  return true;
}

void WeightedJumpPoint::queue(std::uint32_t index, Cell cell, Key g) {
  const Key f = g + estimate(cell);
  if (f >= goal_cost_) return;
  heap_.push_back({f, index});
  std::push_heap(heap_.begin(), heap_.end(), Later());
  ++counts_.generated;
}

void WeightedJumpPoint::runDiagonally(unsigned step, std::uint32_t index, Cell cell, Key g) {
  const CostGrid::Weight* weights = map().weights().values().data();
  const std::ptrdiff_t offset =
      std::ptrdiff_t{kSteps[step].row} * map().geometry().width() + kSteps[step].column;
  const unsigned side = 1U << step;
  for (;;) {
    const auto to = static_cast<std::uint32_t>(index + offset);
    g += kDiagonal * std::max(weights[index], weights[to]);
    index = to;
    cell = moved(cell, step);
    if (jumps_.stopsDiagonal(cell, int(step))) return reach(index, cell, g, step);

    if (!improve(index, g)) return;
    Sides& sides = sides_[index];
    if ((sides.reached & side) != 0) return;
    const NaturalSteps natural = jumps_.natural(map(), index);
    const unsigned steps = kDefaultSteps[step] & ~stepsAfter(natural, sides.expanded);
    sides.reached |= std::uint8_t(side);
    sides.expanded |= std::uint8_t(side);
    for (unsigned straight = steps & 15U; straight != 0; straight &= straight - 1)
      runStraight(unsigned(__builtin_ctz(straight)), cell, g);
    if ((steps & side) == 0) return;
  }
}

// Octile at the cheapest weight.
WeightedJumpPoint::Key WeightedJumpPoint::estimate(Cell cell) const {
  const Key columns = Key(std::abs(cell.column - goal_.column));
  const Key rows = Key(std::abs(cell.row - goal_.row));
  const Key diagonal = std::min(columns, rows);
  return map().cheapest() *
         ((std::max(columns, rows) - diagonal) * kStraight + diagonal * kDiagonal);
}

std::vector<Cell> WeightedJumpPoint::pathTo(Cell start, Cell goal) const {
  std::vector<Cell> cells = {goal};
  while (cells.back() != start) {
    const Cell from = labelledBefore(cells.back());
    const Cell cell = cells.back();
    const Cell step{(from.column > cell.column) - (from.column < cell.column),
                    (from.row > cell.row) - (from.row < cell.row)};
    while (cells.back() != from)
      cells.push_back({cells.back().column + step.column, cells.back().row + step.row});
  }
  std::reverse(cells.begin(), cells.end());
  return cells;
}

// The nearest cell behind one of the runs to `cell` whose label and the run make the cell's cost.
Cell WeightedJumpPoint::labelledBefore(Cell cell) const {
  const GridGeometry& geometry = map().geometry();
  const std::uint32_t index = geometry.index(cell).value();
  const auto step = unsigned(__builtin_ctz(sides_[index].reached));
  const Key length = step < 4 ? kStraight : kDiagonal;
  Key cost = 0;
  Cell at = cell;
  for (;;) {
    const Cell before = moved(at, step, -1);
    cost += length * std::max(map().weight(at), map().weight(before));
    at = before;
    const std::uint32_t from = geometry.index(at).value();
    if (labelled(from) && costOf(from) + cost == costOf(index)) return at;
  }
}

PlanResult WeightedJumpPoint::withStatus(Status status, PlanResult result) const {
  result.status = status;
  result.statistics = counts_;
  result.statistics.search_bytes = bytesFor(map().geometry()) + counts_.peak_open * sizeof(Entry);
  return result;
}

}  // namespace grid_path_planner
