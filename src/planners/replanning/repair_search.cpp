#include "planners/replanning/repair_search.h"

#include <algorithm>

namespace grid_path_planner::planners {

using base::Statistics;
using base::StopPoll;
using costmap::CostGrid;
using grid::Cell;

void RepairSearch::prepare(const CostGrid& map) {
  nodes_.prepare(map.geometry());
  const SearchKey width = kPackedScale.straight * std::max<SearchKey>(map.minWeight(), 1) / 2;
  bucket_shift_ = 63U - static_cast<unsigned>(__builtin_clzll(width));  // see bucket_search.cpp
}

// Inlined by force: position-independent code keeps the compiler from it, and a call for each cell
// costs 6 % of the search.
[[gnu::always_inline]] inline void RepairSearch::expand(const BackwardNodes& labels, Index index,
                                                        Cell cell, Node& node, Statistics& counts) {
  const MovePruning& moves = labels.moves();
  for (std::uint32_t tried = moves.after(node.steps(), index); tried != 0; tried &= tried - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(tried));
    const Index to = labels.along(index, step);
    const SearchKey g = node.g() + labels.stepKey(index, to, step);
    Node& next = nodes_.along(node, cell, step);
    if (g > next.g()) continue;
    if (!labels.known(to)) {
      left_the_tree_ = true;
      continue;
    }
    const SearchKey f = g + labels.g(to);
    if (f >= cost_) {
      overflowed_ = overflowed_ || f >= kNoCost;
      continue;
    }

    // 1. Another way as cheap: it may leave open what the known one does not.
    if (g == next.g()) {
      if (!moves.missing(next.steps(), step, to)) continue;
      next.addStep(step);
      if (!next.closed()) continue;
      next.reopen();
      ++counts.reopened;
    } else {
      // 2. A cheaper one: the tree goes on from here, or the cell is opened, perhaps again.
      if (next.closed()) ++counts.reopened;
      next.reach(g, step);
      const Cell to_cell{cell.column + kSteps[step].column, cell.row + kSteps[step].row};
      if (to != labels.root() && nodes_.along(next, to_cell, labels.stepOf(to)).note() == kUnsound)
        next.setNote(kUnsound);
      if (next.note() != kUnsound && consistentPath(labels, to, to_cell, next)) {
        cost_ = f;
        last_ = to;
        continue;
      }
    }
    open_.push(f, to);
    ++counts.generated;
  }
}

bool RepairSearch::run(const BackwardNodes& labels, Index start, SearchKey sound_below, bool record,
                       SearchResult& result, StopPoll& poll) {
  start_ = last_ = start;
  consistent_below_ = sound_below;
  expanded_ = 0;
  left_the_tree_ = overflowed_ = false;
  nodes_.beginQuery();
  Node& first = nodes_.at(labels.cell(start));
  if (consistentPath(labels, start, labels.cell(start), first)) {
    cost_ = labels.g(start);
    return true;
  }
  cost_ = kNoCost;
  first.begin();
  open_.begin(labels.g(start), bucket_shift_);
  open_.push(labels.g(start), start);
  std::size_t& peak = result.statistics.peak_open;
  while (!open_.empty() && open_.lowest() < cost_) {
    poll();
    peak = std::max(peak, open_.size());
    const Index index = open_.pop();
    const Cell cell = labels.cell(index);
    Node& node = nodes_.at(cell);
    if (node.closed()) continue;
    if (cost_ != kNoCost && node.g() + labels.g(index) >= cost_) continue;
    node.close();
    ++expanded_;
    if (record) result.expanded.emplace_back(index);
    expand(labels, index, cell, node, result.statistics);
  }
  result.statistics.expanded += expanded_;
  return cost_ != kNoCost;
}

// Every cell of the ways that are followed here is looked at once. What is expanded is unsound, and
// so is what leads there.
bool RepairSearch::consistentPath(const BackwardNodes& labels, Index index, Cell cell,
                                  Node& first) {
  bool sound = true;
  checked_.clear();
  Node* node = &first;
  while (labels.g(index) >= consistent_below_ && index != labels.root()) {
    if (node->note() != 0) {
      sound = node->note() == kSound;
      break;
    }
    checked_.push_back(node);
    const std::uint32_t step = labels.stepOf(index);
    Node& ahead = nodes_.along(*node, cell, step);
    if (ahead.note() == kUnsound || !labels.consistent(index)) {
      sound = false;
      break;
    }
    node = &ahead;
    index = labels.along(index, step);
    cell = {cell.column + kSteps[step].column, cell.row + kSteps[step].row};
  }
  for (Node* each : checked_) each->setNote(sound ? kSound : kUnsound);
  return sound;
}

std::vector<Cell> RepairSearch::path(const BackwardNodes& labels) {
  std::vector<Cell> cells;
  for (Index at = last_; at != start_;) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(nodes_.at(labels.cell(at)).steps()));
    at = labels.along(at, oppositeStep(step));
    cells.push_back(labels.cell(at));
  }
  std::reverse(cells.begin(), cells.end());
  Cell cell = labels.cell(last_);
  for (Index at = last_; at != labels.root(); at = labels.next(at)) {
    cells.push_back(cell);
    const Cell step = kSteps[labels.stepOf(at)];
    cell = {cell.column + step.column, cell.row + step.row};
  }
  cells.push_back(cell);
  return cells;
}

// run() expanded all that it had to by the labels of then; a cheaper way would leave the expanded
// cells over one whose label is lower now.
bool RepairSearch::affects(const BackwardNodes& labels, Index index) const {
  const Cell cell = labels.cell(index);
  if (index == start_ || nodes_.closed(cell)) return true;
  for (unsigned mask = labels.stepsFrom(index); mask != 0; mask &= mask - 1) {
    const Cell step = kSteps[static_cast<std::size_t>(__builtin_ctz(mask))];
    if (nodes_.closed({cell.column + step.column, cell.row + step.row})) return true;
  }
  return false;
}

}  // namespace grid_path_planner::planners
