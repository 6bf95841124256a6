#include "planners/jump_point/weighted_jump_map.h"

#include <algorithm>

#include "planners/core/steps.h"
#include "planners/jump_point/dead_ends.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

constexpr int kBand = 128;  // rows whose dead branches are found together

// A cache of natural steps by window, as windows repeat. A new window overwrites another of the same
// hash.
class WindowCache {
 public:
  // `cells`: about as many windows will be asked for.
  explicit WindowCache(std::size_t cells) {
    while (bits_ < 15 && std::size_t{1} << bits_ < cells) ++bits_;
    entries_.resize(std::size_t{1} << bits_);
  }

  NaturalMoves steps(const Window& window) {
    Entry& entry = entries_[hashOf(window)];
    if (!entry.used || entry.window != window) entry = {naturalMoves(window), window, true};
    return entry.steps;
  }

 private:
  struct Entry {
    NaturalMoves steps = 0;
    Window window{};
    bool used = false;
  };

  std::size_t hashOf(const Window& window) const {
    std::uint64_t hash = 0;
    for (const CostGrid::Weight weight : window) hash = (hash ^ weight) * 0x9E3779B97F4A7C15U;
    return hash >> (64 - bits_);
  }

  int bits_ = 1;
  std::vector<Entry> entries_;
};

bool allEqual(const Window& window) {
  return std::all_of(window.begin(), window.end(),
                     [&window](CostGrid::Weight weight) { return weight == window[0]; });
}

void setBit(std::uint64_t& word, int at, bool value) {
  const std::uint64_t bit = std::uint64_t{1} << (unsigned(at) & 63U);
  word = value ? word | bit : word & ~bit;
}

Cell before(Cell cell, unsigned step) {
  return {cell.column - kSteps[step].column, cell.row - kSteps[step].row};
}

}  // namespace

std::size_t WeightedJumpMap::bytesFor(const GridGeometry& geometry) {
  const auto width = std::size_t(geometry.width()), height = std::size_t(geometry.height());
  return StraightJumpTable::bytesFor(height, width) + StraightJumpTable::bytesFor(width, height) +
         geometry.size() * sizeof(Mark);
}

void WeightedJumpMap::build(const CostGrid& map, const StopToken& stop) {
  const GridGeometry& geometry = map.geometry();
  width_ = geometry.width();
  rows_.reset(std::size_t(geometry.height()), std::size_t(geometry.width()));
  columns_.reset(std::size_t(geometry.width()), std::size_t(geometry.height()));
  marks_.assign(geometry.size(), Mark());
  natural_of_id_.clear();
  id_of_natural_.clear();
  Window open;
  open.fill(1);
  idOf(naturalMoves(open));  // kOpenId
  idOf(0);                   // kBlockedId
  computeNaturalIds(map, geometry.rect(), stop);
  for (int row = 0; row < geometry.height(); row += kBand)
    computeLiveSteps(map, CellRect{0, row, width_, kBand}.intersection(geometry.rect()), stop);
  buildStops(map, stop);
}

void WeightedJumpMap::update(const CostGrid& map, const CellRect& changed, const StopToken& stop) {
  const CellRect all = map.geometry().rect();
  computeNaturalIds(map, changed.grown(1).intersection(all), stop);
  const CellRect near = changed.grown(kDepth + 2).intersection(all);
  computeLiveSteps(map, near, stop);
  StopPoll poll(stop, 16);
  for (int row = near.row; row < near.row + near.height; ++row) {
    poll();
    for (int column = near.column; column < near.column + near.width; ++column)
      setStops({column, row}, steps(map, map.geometry().index({column, row}).value()));
  }
}

unsigned WeightedJumpMap::idOf(NaturalMoves natural) {
  const auto found = id_of_natural_.find(natural);
  if (found != id_of_natural_.end()) return found->second;
  if (natural_of_id_.size() == kNoId) return kNoId;
  const auto id = static_cast<unsigned>(natural_of_id_.size());
  natural_of_id_.push_back(natural);
  id_of_natural_.emplace(natural, id);
  return id;
}

void WeightedJumpMap::computeNaturalIds(const CostGrid& map, const CellRect& rect,
                                        const StopToken& stop) {
  WindowCache cache(std::size_t(rect.width) * std::size_t(rect.height));
  StopPoll poll(stop, 8);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    for (int column = rect.column; column < rect.column + rect.width; ++column) {
      const Cell cell{column, row};
      const Window window = windowAt(map, cell);
      const bool blocked = window[4] == CostGrid::kBlocked, equal = !blocked && allEqual(window);
      Mark& mark = marks_[map.geometry().index(cell).value()];
      mark.setNaturalId(equal ? kOpenId : blocked ? kBlockedId : idOf(cache.steps(window)));
      StraightJumpTable::Word& in_row = rows_.word(std::size_t(row), unsigned(column));
      setBit(in_row.open, column, equal);
      setBit(in_row.change, column, window[4] != window[5]);
      setBit(columns_.word(std::size_t(column), unsigned(row)).change, row, window[4] != window[7]);
    }
  }
}

void WeightedJumpMap::computeLiveSteps(const CostGrid& map, const CellRect& rect,
                                       const StopToken& stop) {
  const CellRect window = rect.grown(kDepth + 1).intersection(map.geometry().rect());
  std::vector<NaturalMoves> natural;
  natural.reserve(std::size_t(window.width) * window.height);
  StopPoll poll(stop, 16);
  for (int row = window.row; row < window.row + window.height; ++row) {
    poll();
    for (int column = window.column; column < window.column + window.width; ++column)
      natural.push_back(this->natural(map, map.geometry().index({column, row}).value()));
  }
  const std::vector<std::uint8_t> live = liveSteps(natural, window.width, window.height, kDepth);
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      marks_[map.geometry().index({column, row}).value()].live =
          live[std::size_t(row - window.row) * window.width + (column - window.column)];
}

// Against the direction of the jumps, so that the dead ends before each stop are written once.
void WeightedJumpMap::buildStops(const CostGrid& map, const StopToken& stop) {
  const int height = map.geometry().height();
  StopPoll poll(stop, 16);
  for (int row = 0; row < height; ++row) {
    poll();
    for (int column = 0; column < width_; ++column) buildStopsOf<true>(map, {column, row});
  }
  for (int row = height - 1; row >= 0; --row) {
    poll();
    for (int column = width_ - 1; column >= 0; --column) buildStopsOf<false>(map, {column, row});
  }
}

template <bool kForward>
void WeightedJumpMap::buildStopsOf(const CostGrid& map, Cell cell) {
  const std::uint32_t index = map.geometry().index(cell).value();
  const Mark& mark = marks_[index];
  if (mark.naturalId() != kOpenId || mark.live != 255)
    setStopsOf<kForward>(cell, steps(map, index));
}

template <bool kForward>
void WeightedJumpMap::setStopsOf(Cell cell, NaturalMoves steps) {
  const unsigned along_row = kForward ? 0 : 2, along_column = kForward ? 1 : 3;
  const unsigned in_row = steps >> (8 * along_row) & 255U;
  const unsigned in_column = steps >> (8 * along_column) & 255U;
  rows_.setStop<kForward>(std::size_t(cell.row), unsigned(cell.column), in_row != 1U << along_row,
                          in_row == 0);
  columns_.setStop<kForward>(std::size_t(cell.column), unsigned(cell.row),
                             in_column != 1U << along_column, in_column == 0);
}

void WeightedJumpMap::setStops(Cell cell, NaturalMoves steps) {
  setStopsOf<true>(cell, steps);
  setStopsOf<false>(cell, steps);
}

void WeightedJumpMap::setOpen(Cell cell, bool open) {
  setBit(rows_.word(std::size_t(cell.row), unsigned(cell.column)).open, cell.column, open);
}

WeightedJumpMap::ScopedGoal::ScopedGoal(WeightedJumpMap& jumps, const CostGrid& map, Cell goal)
    : jumps_(jumps), map_(map), goal_(goal), was_open_(jumps.open(goal)) {
  restoreStepsTo(goal, deadAfter(jumps.steps(map, map.geometry().index(goal).value())));
  for (const Change& change : changes_)
    jumps_.setStops(change.cell, jumps_.steps(map, map.geometry().index(change.cell).value()));
  jumps_.setOpen(goal, false);
  jumps_.setStops(goal, ~NaturalMoves{0});
}

// Makes live the steps of `dead` that lead to the cell, although no step is natural after them, and
// likewise the dead steps that lead to these.
void WeightedJumpMap::ScopedGoal::restoreStepsTo(Cell cell, unsigned dead) {
  struct Entry {
    Cell cell;
    unsigned dead;
  };
  std::vector<Entry> stack = {{cell, dead}};
  while (!stack.empty()) {
    const Entry next = stack.back();
    stack.pop_back();
    for (unsigned bits = next.dead; bits != 0; bits &= bits - 1) {
      const auto step = unsigned(__builtin_ctz(bits));
      const Cell from = before(next.cell, step);
      if (!map_.passable(from)) continue;
      const std::uint32_t index = map_.geometry().index(from).value();
      Mark& mark = jumps_.marks_[index];
      if ((mark.live >> step & 1U) != 0) continue;
      const NaturalMoves natural = jumps_.natural(map_, index);
      const unsigned taken = ~deadAfter(natural & (kEveryByte << step)) & 255U;
      const unsigned was_dead = deadAfter(natural & (mark.live * kEveryByte));
      if (taken == 0) continue;
      changes_.push_back({from, mark.live});
      mark.live |= static_cast<std::uint8_t>(1U << step);
      if ((taken & was_dead) != 0) stack.push_back({from, taken & was_dead});
    }
  }
}

WeightedJumpMap::ScopedGoal::~ScopedGoal() {
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change)
    jumps_.marks_[map_.geometry().index(change->cell).value()].live = change->live;
  changes_.push_back({goal_, 0});
  for (const Change& change : changes_)
    jumps_.setStops(change.cell, jumps_.steps(map_, map_.geometry().index(change.cell).value()));
  jumps_.setOpen(goal_, was_open_);
}

}  // namespace grid_path_planner::planners
