#include "planners/replanning/repair_search.h"

#include <algorithm>

namespace grid_path_planner::planners {

using base::Statistics, base::StopPoll;
using costmap::CostGrid;
using grid::Cell;

void RepairSearch::prepare(const CostGrid& map) {
  nodes_.prepare(map.geometry());
  const SearchKey width = kPackedScale.straight * std::max<SearchKey>(map.minWeight(), 1) / 2;
  bucket_shift_ = 63U - static_cast<unsigned>(__builtin_clzll(width));  // see bucket_search.cpp
}

// Inlined by force: position-independent code prevents it otherwise, and a call for each cell costs
// 6 % of the search.
[[gnu::always_inline]] inline void RepairSearch::expand(const BackwardNodes& tree, Index index,
                                                        Cell cell, Node& node, Statistics& counts) {
  const MovePruning& moves = tree.moves();
  for (std::uint32_t tried = moves.after(node.steps(), index); tried != 0; tried &= tried - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(tried));
    const Index to = tree.along(index, step);
    const SearchKey g = node.g() + tree.stepKey(index, to, step);
    Node& next = nodes_.along(node, cell, step);
    if (g > next.g()) continue;
    if (!tree.known(to)) {
      left_the_tree_ = true;
      continue;
    }
    const SearchKey f = g + tree.g(to);
    if (f >= cost_) {
      overflowed_ = overflowed_ || f >= kNoCost;
      continue;
    }

    // 1. Another path of equal cost: after its step other moves may be natural.
    if (g == next.g()) {
      if (!moves.missing(next.steps(), step, to)) continue;
      next.addStep(step);
      if (!next.closed()) continue;
      next.reopen();
      ++counts.reopened;
    } else {
      // 2. A cheaper path: it continues along the tree, or the cell is opened or re-opened.
      if (next.closed()) ++counts.reopened;
      next.reach(g, step);
      const Cell to_cell{cell.column + kSteps[step].column, cell.row + kSteps[step].row};
      if (to != tree.root() && nodes_.along(next, to_cell, tree.stepOf(to)).note() == kInconsistent)
        next.setNote(kInconsistent);
      if (next.note() != kInconsistent && consistentPath(tree, to, to_cell, next)) {
        cost_ = f;
        last_ = to;
        continue;
      }
    }
    open_.push(f, to);
    ++counts.generated;
  }
}

bool RepairSearch::run(const BackwardNodes& tree, Index start, SearchKey consistent_below,
                       bool record, SearchResult& result, StopPoll& poll, std::uint64_t most) {
  start_ = last_ = start;
  consistent_below_ = consistent_below;
  expanded_ = 0;
  left_the_tree_ = overflowed_ = false;
  nodes_.beginQuery();
  Node& first = nodes_.at(tree.cell(start));
  if (consistentPath(tree, start, tree.cell(start), first)) {
    cost_ = tree.g(start);
    return true;
  }
  cost_ = kNoCost;
  first.setStart();
  open_.reset(tree.g(start), bucket_shift_);
  open_.push(tree.g(start), start);
  std::size_t& peak = result.statistics.peak_open;
  while (!open_.empty() && open_.lowest() < cost_) {
    poll();
    peak = std::max(peak, open_.size());
    const Index index = open_.pop();
    const Cell cell = tree.cell(index);
    Node& node = nodes_.at(cell);
    if (node.closed()) continue;
    if (cost_ != kNoCost && node.g() + tree.g(index) >= cost_) continue;
    if (expanded_ == most) {
      result.statistics.expanded += expanded_;
      throw TooManyCells();
    }
    node.close();
    ++expanded_;
    if (record) result.expanded.emplace_back(index);
    expand(tree, index, cell, node, result.statistics);
  }
  result.statistics.expanded += expanded_;
  return cost_ != kNoCost;
}

// Whether the tree's path from the cell is consistent. Visits every cell once in a query: an expanded
// cell is inconsistent, and so are all whose paths pass it.
bool RepairSearch::consistentPath(const BackwardNodes& tree, Index index, Cell cell, Node& first) {
  bool consistent = true;
  checked_.clear();
  Node* node = &first;
  while (tree.g(index) >= consistent_below_ && index != tree.root()) {
    if (node->note() != 0) {
      consistent = node->note() == kConsistent;
      break;
    }
    checked_.push_back(node);
    const std::uint32_t step = tree.stepOf(index);
    Node& ahead = nodes_.along(*node, cell, step);
    if (ahead.note() == kInconsistent || !tree.consistent(index)) {
      consistent = false;
      break;
    }
    node = &ahead;
    index = tree.along(index, step);
    cell = {cell.column + kSteps[step].column, cell.row + kSteps[step].row};
  }
  for (Node* each : checked_) each->setNote(consistent ? kConsistent : kInconsistent);
  return consistent;
}

std::vector<Cell> RepairSearch::path(const BackwardNodes& tree) {
  std::vector<Cell> cells;
  for (Index at = last_; at != start_;) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(nodes_.at(tree.cell(at)).steps()));
    at = tree.along(at, oppositeStep(step));
    cells.push_back(tree.cell(at));
  }
  std::reverse(cells.begin(), cells.end());
  Cell cell = tree.cell(last_);
  for (Index at = last_; at != tree.root(); at = tree.next(at)) {
    cells.push_back(cell);
    const Cell step = kSteps[tree.stepOf(at)];
    cell = {cell.column + step.column, cell.row + step.row};
  }
  cells.push_back(cell);
  return cells;
}

// run() expanded all cells that it had to by the g-values of then: a cheaper path would have to leave
// the expanded cells over a cell whose g-value is lower now.
bool RepairSearch::affects(const BackwardNodes& tree, Index index) const {
  const Cell cell = tree.cell(index);
  if (index == start_ || nodes_.closed(cell)) return true;
  for (unsigned mask = tree.stepsFrom(index); mask != 0; mask &= mask - 1) {
    const Cell step = kSteps[static_cast<std::size_t>(__builtin_ctz(mask))];
    if (nodes_.closed({cell.column + step.column, cell.row + step.row})) return true;
  }
  return false;
}

}  // namespace grid_path_planner::planners
