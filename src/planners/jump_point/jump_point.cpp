#include "planners/jump_point/jump_point.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "planners/core/keys.h"
#include "planners/jump_point/jump_geometry.h"

namespace grid_path_planner::planners {

using base::Status, base::Stopped, base::StopPoll, base::StopReason, base::StopToken;
using costmap::BitMap, costmap::BitMaps, costmap::ExactCost;
using grid::Cell, grid::CellIndex, grid::CellRect, grid::GridGeometry;

namespace {

// An expansion may scan the map's width and height several times.
constexpr std::uint32_t kExpansionsBetweenPolls = 64;

// One search, with the state that every part of an expansion needs.
template <class Scale>
class Search {
 public:
  using Key = typename Scale::Key;
  using Nodes = HashedNodes<Key>;

  using Open = RadixHeap<Key>;

  Search(const BitMap& free, const JumpPointBits& jump_points, Nodes& nodes, Open& open,
         const SearchRequest& request, const StopToken& stop)
      : free_(free),
        jump_points_(jump_points),
        nodes_(nodes),
        open_(open),
        request_(request),
        goal_(request.goals.front()),
        poll_(stop, kExpansionsBetweenPolls) {}

  enum class Outcome { FOUND, EXHAUSTED, TOO_LARGE };

  // Fills in the result's expanded cells and statistics. `stopped`: why it ended early.
  Outcome run(SearchResult& result, StopReason& stopped) {
    openStart();
    const Outcome outcome = expandUntilDone(result, stopped);
    result.statistics.generated = generated_;
    result.statistics.reopened = reopened_;
    result.statistics.peak_open = open_.peakSize();
    return outcome;
  }

  // All cells from the start to the goal and their cost. Precondition: run() was FOUND.
  void trace(std::int64_t weight, SearchResult& result) const {
    ExactCost lengths;
    for (std::uint32_t at = goal_number_; at != 0; at = nodes_[at].parent) {
      const Cell to = nodes_.cell(at), from = nodes_.cell(nodes_[at].parent);
      const int columns = std::abs(to.column - from.column), rows = std::abs(to.row - from.row);
      lengths += {std::abs(columns - rows), std::min(columns, rows)};
    }
    result.cost = lengths * weight;
    result.cells.resize(static_cast<std::size_t>(1 + lengths.straight + lengths.diagonal));
    Cell* end = result.cells.data() + result.cells.size();
    for (std::uint32_t at = goal_number_; at != 0; at = nodes_[at].parent)
      end = writeBackwards(nodes_.cell(nodes_[at].parent), nodes_.cell(at), end);
    result.cells.front() = request_.start;
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::uint8_t kEverywhere = 15;
  static constexpr std::size_t kBranches = 64;

  static Key length(int diagonals, int straights) {
    return static_cast<Key>(diagonals) * Scale::kDiagonal +
           static_cast<Key>(straights) * Scale::kStraight;
  }
  Key estimate(Cell cell) const {
    const int columns = std::abs(cell.column - goal_.column);
    const int rows = std::abs(cell.row - goal_.row);
    return columns < rows ? length(columns, rows - columns) : length(rows, columns - rows);
  }

  void openStart() {
    nodes_.reset(free_.width());
    open_.clear();
    const std::uint32_t start = nodes_.findOrInsert(request_.start);
    goal_number_ = request_.start == goal_ ? start : kNone;
    nodes_[start].reached_by = nodes_[start].unexpanded = kEverywhere;
    open_.push(estimate(request_.start), start);
    generated_ = 1;
  }

  Outcome expandUntilDone(SearchResult& result, StopReason& stopped) {
    while (!open_.empty()) {
      stopped = poll_.ask();
      if (stopped != StopReason::NONE) break;
      number_ = open_.pop();
      auto& node = nodes_[number_];
      if (node.unexpanded == 0) continue;
      ++result.statistics.expanded;
      if (request_.record_expanded) result.expanded.push_back(cellIndex(nodes_.cell(number_)));
      if (number_ == goal_number_) return Outcome::FOUND;
      const std::uint8_t steps = node.unexpanded;
      node.unexpanded = 0;
      expand(nodes_.cell(number_), node.g, steps);
      if (too_large_) return Outcome::TOO_LARGE;
    }
    return Outcome::EXHAUSTED;
  }

  CellIndex cellIndex(Cell cell) const {
    return CellIndex(static_cast<std::uint32_t>(cell.row) * std::uint32_t(free_.width()) +
                     static_cast<std::uint32_t>(cell.column));
  }

  // Writes the cells after `from` of the jump to `to`, diagonal steps first, so that the last one
  // is end[-1]. Returns the first one's address.
  static Cell* writeBackwards(Cell from, Cell to, Cell* end) {
    const int columns = to.column - from.column, rows = to.row - from.row;
    const int dx = (columns > 0) - (columns < 0), dy = (rows > 0) - (rows < 0);
    const int straights = std::abs(std::abs(columns) - std::abs(rows));
    const bool wide = std::abs(columns) > std::abs(rows);
    for (int i = 0; i < straights; ++i) {
      *--end = to;
      (wide ? to.column -= dx : to.row -= dy);
    }
    for (; to.column != from.column; to.column -= dx, to.row -= dy) *--end = to;
    return end;
  }

  void expand(Cell from, Key g, std::uint8_t reached_by) {
    const unsigned steps = successorStepsAfterAny(from, reached_by);
    if ((steps & 1U << 0) != 0) jumpStraight<0>(from, g);
    if ((steps & 1U << 1) != 0) jumpStraight<1>(from, g);
    if ((steps & 1U << 2) != 0) jumpStraight<2>(from, g);
    if ((steps & 1U << 3) != 0) jumpStraight<3>(from, g);
    if ((steps & 1U << 4) != 0) jumpDiagonally<4>(from, g);
    if ((steps & 1U << 5) != 0) jumpDiagonally<5>(from, g);
    if ((steps & 1U << 6) != 0) jumpDiagonally<6>(from, g);
    if ((steps & 1U << 7) != 0) jumpDiagonally<7>(from, g);
    jumpFromAllBranches();
  }

  // A straight jump that is known to end at a jump point and was not made yet.
  struct Branch {
    Cell from;
    Key g;
  };
  struct Branches {
    std::array<Branch, kBranches> all;
    std::size_t count = 0;

    void addIf(bool wanted, Branch branch) {
      all[count] = branch;
      count += wanted ? 1 : 0;
    }
  };

  // Makes the straight jumps of all branches. They are collected before, so that the reading of
  // many lines of the map overlaps.
  void jumpFromAllBranches() {
    jumpFromBranches<0>();
    jumpFromBranches<1>();
    jumpFromBranches<2>();
    jumpFromBranches<3>();
  }
  template <int step>
  void jumpFromBranches() {
    Branches& branches = branches_[step];
    for (std::size_t i = 0; i < branches.count; ++i) {
      Branch& branch = branches.all[i];
      const int stop = jump_points_.firstStop(step, branch.from);
      if (step % 2 == 0) {
        branch.g += length(0, std::abs(stop - branch.from.column));
        branch.from.column = stop;
      } else {
        branch.g += length(0, std::abs(stop - branch.from.row));
        branch.from.row = stop;
      }
    }
    for (std::size_t i = 0; i < branches.count; ++i)
      reach(branches.all[i].from, branches.all[i].g, step);
    branches.count = 0;
  }

  // The natural and forced neighbours of a jump point that was reached by a straight step, a bit
  // for every step: straight on, and around the obstacle that ends beside it.
  template <int step>
  unsigned successorSteps(Cell jump_point) const {
    constexpr int left = (step + 1) % 4, right = (step + 3) % 4;
    constexpr unsigned around_left = 1U << left | 1U << diagonalBetween(step, left);
    constexpr unsigned around_right = 1U << right | 1U << diagonalBetween(step, right);
    const Cell before = moved(jump_point, step, -1);
    const bool ends_left = !free_[moved(before, left, 1)] && free_[moved(jump_point, left, 1)];
    const bool ends_right = !free_[moved(before, right, 1)] && free_[moved(jump_point, right, 1)];
    return 1U << step | (ends_left ? around_left : 0U) | (ends_right ? around_right : 0U);
  }
  unsigned successorStepsAfterAny(Cell from, std::uint8_t reached_by) const {
    if (reached_by == kEverywhere) return 255;
    return ((reached_by & 1U) != 0 ? successorSteps<0>(from) : 0U) |
           ((reached_by & 2U) != 0 ? successorSteps<1>(from) : 0U) |
           ((reached_by & 4U) != 0 ? successorSteps<2>(from) : 0U) |
           ((reached_by & 8U) != 0 ? successorSteps<3>(from) : 0U);
  }

  template <int step>
  void jumpStraight(Cell from, Key g) {
    if (goalAhead(from, step)) {
      const int steps = std::abs(goal_.column - from.column) + std::abs(goal_.row - from.row);
      return reach(goal_, g + length(0, steps), step);
    }
    branches_[step].addIf(jump_points_.leadsToJumpPoint(step, from), {from, g});
  }

  // Whether a straight jump meets the goal, at its first stop or before.
  bool goalAhead(Cell from, int step) const {
    if (step % 2 == 0) {
      if (goal_.row != from.row || (goal_.column - from.column) * kSteps[step].column <= 0)
        return false;
      const int stop = jump_points_.firstStop(step, from);
      return step == 0 ? stop >= goal_.column : stop <= goal_.column;
    }
    if (goal_.column != from.column || (goal_.row - from.row) * kSteps[step].row <= 0) return false;
    const int stop = jump_points_.firstStop(step, from);
    return step == 1 ? stop >= goal_.row : stop <= goal_.row;
  }

  // Goes diagonally and collects, from every cell that is passed, the straight branches that lead
  // to jump points or to the goal.
  template <int step>
  void jumpDiagonally(Cell from, Key g) {
    constexpr int horizontal = horizontalPart(step), vertical = verticalPart(step);
    constexpr int dx = kSteps[step].column, dy = kSteps[step].row;
    const int goal_columns = (goal_.column - from.column) * dx;
    const int goal_rows = (goal_.row - from.row) * dy;
    const int goal_line =
        goal_columns >= 0 && goal_rows >= 0 ? std::min(goal_columns, goal_rows) : 0;
    Cell cell = from;
    int passed = 0;
    while (true) {
      const DiagonalJumpBits::Stop stop = jump_points_.template diagonalStop<step>(cell);
      cell = {cell.column + dx * stop.steps, cell.row + dy * stop.steps};
      passed += stop.steps;
      if (!stop.horizontal && !stop.vertical) break;
      const Branch branch{cell, g + length(passed, 0)};
      if (branches_[horizontal].count == kBranches - 1 ||
          branches_[vertical].count == kBranches - 1)
        jumpFromAllBranches();
      branches_[horizontal].addIf(stop.horizontal, branch);
      branches_[vertical].addIf(stop.vertical, branch);
    }
    if (0 < goal_line && goal_line < passed) jumpToGoal(from, g, step, goal_line);
  }

  // From the cell of a diagonal jump that lies in the goal's column or row, or is the goal.
  void jumpToGoal(Cell from, Key g, int step, int diagonals) {
    const Cell cell = moved(from, step, diagonals);
    const Key to_g = g + length(diagonals, 0);
    if (cell == goal_) return reach(goal_, to_g, horizontalPart(step));
    const int straight = cell.row == goal_.row ? horizontalPart(step) : verticalPart(step);
    if (!goalAhead(cell, straight)) return;
    const int steps = std::abs(goal_.column - cell.column) + std::abs(goal_.row - cell.row);
    reach(goal_, to_g + length(0, steps), straight);
  }

  // Relaxes the node of a jump point or the goal: by a lower g-value, or by an equal one that
  // arrives by another step.
  void reach(Cell cell, Key g, int step) {
    if (g >= Scale::kLargest) {
      too_large_ = true;
      return;
    }
    const std::uint32_t number = nodes_.findOrInsert(cell);
    auto& node = nodes_[number];
    const auto bit = static_cast<std::uint8_t>(1U << step);
    if (node.reached_by == 0 || g < node.g) {
      if (node.reached_by != 0 && node.unexpanded == 0) ++reopened_;
      node.reached_by = node.unexpanded = bit;
      node.g = g;
      node.parent = number_;
      if (cell == goal_) goal_number_ = number;
    } else if (g == node.g && (node.reached_by & bit) == 0) {
      const bool queued = node.unexpanded != 0;
      node.reached_by |= bit;
      node.unexpanded |= bit;
      if (queued) return;
      ++reopened_;
    } else {
      return;
    }
    open_.push(g + estimate(cell), number);
    ++generated_;
  }

  const BitMap& free_;
  const JumpPointBits& jump_points_;
  Nodes& nodes_;
  Open& open_;
  const SearchRequest& request_;
  const Cell goal_;
  StopPoll poll_;
  std::uint32_t number_ = 0;  // of the node that is expanded
  std::uint32_t goal_number_ = kNone;
  std::uint64_t generated_ = 0;
  std::uint64_t reopened_ = 0;
  bool too_large_ = false;
  std::array<Branches, 4> branches_;  // by straight step
};

std::size_t bitBytes(const GridGeometry& geometry) {
  return BitMaps::bytesFor(geometry) + JumpPointBits::bytesFor(geometry);
}

}  // namespace

PlannerTraits JumpPoint::declaredTraits() {
  PlannerTraits traits{"jump_point"};
  traits.four_connected = false;
  traits.unit_diagonals = false;
  traits.cut_corners = false;
  traits.weights = false;
  traits.optimal = true;
  traits.repairs = true;
  return traits;
}

JumpPoint::JumpPoint() : Planner(declaredTraits()) {}

// On noise up to half of the cells are jump points, and a search that generates all of them needs a
// node, two slots of the table and a share of the open list for each.
std::size_t JumpPoint::bytesFor(const GridGeometry& geometry) const {
  constexpr std::size_t kJumpPointBytes = sizeof(HashedNodes<std::uint32_t>::Node) + 12;
  return bitBytes(geometry) + geometry.size() / 2 * kJumpPointBytes;
}

void JumpPoint::doPrepare(const StopToken& stop) {
  jump_points_.build(map().bitMaps(stop), stop);
}

void JumpPoint::doUpdate(const std::vector<CellRect>& changed, const StopToken& stop) {
  for (const CellRect& rect : changed) jump_points_.update(map().bitMaps(stop), rect, stop);
}

template <class Scale>
std::optional<SearchResult> JumpPoint::searchWith(Memory<typename Scale::Key>& memory,
                                                  const SearchRequest& request,
                                                  const StopToken& stop) {
  using Outcome = typename Search<Scale>::Outcome;
  Search<Scale> search(map().bitMaps(stop).rows, jump_points_, memory.nodes, memory.open, request,
                       stop);
  SearchResult result;
  StopReason stopped = StopReason::NONE;
  const Outcome outcome = search.run(result, stopped);
  if (outcome == Outcome::TOO_LARGE) return std::nullopt;
  result.status = Status::UNREACHABLE;
  if (stopped != StopReason::NONE) result.status = Stopped(stopped).status();
  if (outcome == Outcome::FOUND) {
    result.status = Status::FOUND;
    search.trace(std::int64_t{map().minWeight()} * map().kernel(), result);
  }
  result.statistics.search_bytes = bitBytes(map().geometry()) + memory.bytes();
  return result;
}

SearchResult JumpPoint::doSearch(const SearchRequest& request, const StopToken& stop) {
  // g + h must fit into 32 bits: on a map whose sides are at most 2^15 cells h is below 2^31.
  const GridGeometry& geometry = map().geometry();
  if (std::max(geometry.width(), geometry.height()) <= 1 << 15)
    if (auto result = searchWith<SmallScale>(small_, request, stop)) return std::move(*result);
  if (auto result = searchWith<LargeScale>(large_, request, stop)) return std::move(*result);
  throw TooExpensive();
}

}  // namespace grid_path_planner::planners
