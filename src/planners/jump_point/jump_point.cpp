#include "planners/jump_point/jump_point.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "grid_path_planner/planners/keys.h"

namespace grid_path_planner::planners {

using base::Statistics;
using base::Status;
using base::Stopped;
using base::StopPoll;
using base::StopReason;
using base::StopToken;
using costmap::BitMap;
using costmap::BitMaps;
using costmap::ExactCost;
using grid::Cell;
using grid::CellIndex;
using grid::CellRect;
using grid::GridGeometry;

namespace {

// An expansion may cross the map several times.
constexpr std::uint32_t kExpansionsBetweenPolls = 64;

// Keys of one cell length and one diagonal, neighbouring convergents of sqrt 2: the order of keys
// below kLargest is that of costs (see costmap/exact_cost.h).
struct SmallScale {
  using Key = std::uint32_t;
  static constexpr Key kStraight = kSmallScale.straight;
  static constexpr Key kDiagonal = kSmallScale.diagonal;
  static constexpr Key kLargest = kSmallScale.largest;
};
struct LargeScale {
  using Key = std::uint64_t;
  static constexpr Key kStraight = kStraightKey;
  static constexpr Key kDiagonal = kDiagonalKey;
  static constexpr Key kLargest = kLargestKey;
};

// The straight steps that a diagonal step is made of: columns, then rows.
constexpr int sideOf(int diagonal) {
  return kSteps[diagonal].column > 0 ? 0 : 2;
}
constexpr int heightOf(int diagonal) {
  return kSteps[diagonal].row > 0 ? 1 : 3;
}
constexpr int diagonalBetween(int a, int b) {
  const int side = a % 2 == 0 ? a : b, height = a % 2 == 0 ? b : a;
  return height == 1 ? (side == 0 ? 4 : 5) : (side == 0 ? 7 : 6);
}

constexpr Cell moved(Cell cell, int step, int times) {
  return {cell.column + times * kSteps[step].column, cell.row + times * kSteps[step].row};
}

// One search: what every part of an expansion needs.
template <class Scale>
class Search {
 public:
  using Key = typename Scale::Key;
  using Nodes = HashedNodes<Key>;

  Search(const BitMap& free, const JumpPointBits& maps, Nodes& nodes, const SearchRequest& request,
         const StopToken& stop)
      : free_(free),
        maps_(maps),
        nodes_(nodes),
        request_(request),
        goal_(request.goals.front()),
        poll_(stop, kExpansionsBetweenPolls) {}

  enum class Outcome { FOUND, EXHAUSTED, TOO_LARGE };

  // The result gets its expanded cells and statistics. Throws nothing; `stopped` says why it ended.
  Outcome run(SearchResult& result, StopReason& stopped) {
    Statistics& counts = result.statistics;
    nodes_.begin(free_.width());
    const std::uint32_t start = nodes_.find(request_.start);
    goal_number_ = request_.start == goal_ ? start : kNone;
    nodes_[start].arrived = nodes_[start].waiting = kEverywhere;
    nodes_.push(estimate(request_.start), start);
    generated_ = 1;
    Outcome outcome = Outcome::EXHAUSTED;
    while (nodes_.open()) {
      stopped = poll_.ask();
      if (stopped != StopReason::NONE) break;
      number_ = nodes_.pop();
      auto& node = nodes_[number_];
      if (node.waiting == 0) continue;
      ++counts.expanded;
      if (request_.record_expanded) result.expanded.push_back(cellIndex(nodes_.cell(number_)));
      if (number_ == goal_number_) {
        outcome = Outcome::FOUND;
        break;
      }
      const std::uint8_t steps = node.waiting;
      node.waiting = 0;
      expand(nodes_.cell(number_), node.g, steps);
      if (too_large_) {
        outcome = Outcome::TOO_LARGE;
        break;
      }
    }
    counts.generated = generated_;
    counts.reopened = reopened_;
    counts.peak_open = nodes_.peakOpen();
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
  CellIndex cellIndex(Cell cell) const {
    return CellIndex(static_cast<std::uint32_t>(cell.row) * std::uint32_t(free_.width()) +
                     static_cast<std::uint32_t>(cell.column));
  }

  // Of a way from `from` to `to` that is diagonal first: the cells after `from`, the last at
  // end[-1]. Returns where they begin.
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

  void expand(Cell from, Key g, std::uint8_t steps) {
    const unsigned ways = waysFrom(from, steps);
    if ((ways & 1U << 0) != 0) goStraight<0>(from, g);
    if ((ways & 1U << 1) != 0) goStraight<1>(from, g);
    if ((ways & 1U << 2) != 0) goStraight<2>(from, g);
    if ((ways & 1U << 3) != 0) goStraight<3>(from, g);
    if ((ways & 1U << 4) != 0) goDiagonally<4>(from, g);
    if ((ways & 1U << 5) != 0) goDiagonally<5>(from, g);
    if ((ways & 1U << 6) != 0) goDiagonally<6>(from, g);
    if ((ways & 1U << 7) != 0) goDiagonally<7>(from, g);
    jumpAll();
  }

  // A straight way that leads to a turn, still to be gone.
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

  // Branches wait here, so that the reading of many lines of the map overlaps.
  void jumpAll() {
    jumpFrom<0>();
    jumpFrom<1>();
    jumpFrom<2>();
    jumpFrom<3>();
  }
  template <int step>
  void jumpFrom() {
    Branches& branches = branches_[step];
    for (std::size_t i = 0; i < branches.count; ++i) {
      Branch& branch = branches.all[i];
      const int stop = maps_.stop(step, branch.from);
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

  // Where to go on from a turn that was reached by a straight step: straight on, and around the
  // obstacle that ends beside it.
  template <int step>
  unsigned waysAfter(Cell turn) const {
    constexpr int left = (step + 1) % 4, right = (step + 3) % 4;
    constexpr unsigned around_left = 1U << left | 1U << diagonalBetween(step, left);
    constexpr unsigned around_right = 1U << right | 1U << diagonalBetween(step, right);
    const Cell before = moved(turn, step, -1);
    const bool ends_left = !free_[moved(before, left, 1)] && free_[moved(turn, left, 1)];
    const bool ends_right = !free_[moved(before, right, 1)] && free_[moved(turn, right, 1)];
    return 1U << step | (ends_left ? around_left : 0U) | (ends_right ? around_right : 0U);
  }
  unsigned waysFrom(Cell from, std::uint8_t steps) const {
    if (steps == kEverywhere) return 255;
    return ((steps & 1U) != 0 ? waysAfter<0>(from) : 0U) |
           ((steps & 2U) != 0 ? waysAfter<1>(from) : 0U) |
           ((steps & 4U) != 0 ? waysAfter<2>(from) : 0U) |
           ((steps & 8U) != 0 ? waysAfter<3>(from) : 0U);
  }

  template <int step>
  void goStraight(Cell from, Key g) {
    if (goalAhead(from, step)) {
      const int steps = std::abs(goal_.column - from.column) + std::abs(goal_.row - from.row);
      return reach(goal_, g + length(0, steps), step);
    }
    branches_[step].addIf(maps_.leads(step, from), {from, g});
  }

  // Whether the goal lies on the straight way, not beyond its first stop.
  bool goalAhead(Cell from, int step) const {
    if (step % 2 == 0) {
      if (goal_.row != from.row || (goal_.column - from.column) * kSteps[step].column <= 0)
        return false;
      const int stop = maps_.stop(step, from);
      return step == 0 ? stop >= goal_.column : stop <= goal_.column;
    }
    if (goal_.column != from.column || (goal_.row - from.row) * kSteps[step].row <= 0) return false;
    const int stop = maps_.stop(step, from);
    return step == 1 ? stop >= goal_.row : stop <= goal_.row;
  }

  // From `from` diagonally: from every cell on the way the straight ways that lead to turns, and
  // to the goal.
  template <int step>
  void goDiagonally(Cell from, Key g) {
    constexpr int side = sideOf(step), height = heightOf(step);
    constexpr int dx = kSteps[step].column, dy = kSteps[step].row;
    const int goal_columns = (goal_.column - from.column) * dx;
    const int goal_rows = (goal_.row - from.row) * dy;
    const int goal_line =
        goal_columns >= 0 && goal_rows >= 0 ? std::min(goal_columns, goal_rows) : 0;
    Cell cell = from;
    int gone = 0;
    while (true) {
      const DiagonalJumpBits::Stop stop = maps_.template diagonalStop<step>(cell);
      cell = {cell.column + dx * stop.steps, cell.row + dy * stop.steps};
      gone += stop.steps;
      if (!stop.side && !stop.height) break;
      const Branch branch{cell, g + length(gone, 0)};
      if (branches_[side].count == kBranches - 1 || branches_[height].count == kBranches - 1)
        jumpAll();
      branches_[side].addIf(stop.side, branch);
      branches_[height].addIf(stop.height, branch);
    }
    if (0 < goal_line && goal_line < gone) goTowardsGoal(from, g, step, goal_line);
  }

  // From the cell of a diagonal way that lies in the goal's column or row, or is the goal.
  void goTowardsGoal(Cell from, Key g, int step, int diagonals) {
    const Cell cell = moved(from, step, diagonals);
    const Key to_g = g + length(diagonals, 0);
    if (cell == goal_) return reach(goal_, to_g, sideOf(step));
    const int straight = cell.row == goal_.row ? sideOf(step) : heightOf(step);
    if (!goalAhead(cell, straight)) return;
    const int steps = std::abs(goal_.column - cell.column) + std::abs(goal_.row - cell.row);
    reach(goal_, to_g + length(0, steps), straight);
  }

  // A way to a turn or the goal: the node gets it if it is cheaper, or as cheap from another side.
  void reach(Cell cell, Key g, int step) {
    if (g >= Scale::kLargest) {
      too_large_ = true;
      return;
    }
    const std::uint32_t number = nodes_.find(cell);
    auto& node = nodes_[number];
    const auto bit = static_cast<std::uint8_t>(1U << step);
    if (node.arrived == 0 || g < node.g) {
      if (node.arrived != 0 && node.waiting == 0) ++reopened_;
      node.arrived = node.waiting = bit;
      node.g = g;
      node.parent = number_;
      if (cell == goal_) goal_number_ = number;
    } else if (g == node.g && (node.arrived & bit) == 0) {
      const bool queued = node.waiting != 0;
      node.arrived |= bit;
      node.waiting |= bit;
      if (queued) return;
      ++reopened_;
    } else {
      return;
    }
    nodes_.push(g + estimate(cell), number);
    ++generated_;
  }

  const BitMap& free_;
  const JumpPointBits& maps_;
  Nodes& nodes_;
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

// The bits.
std::size_t mapBytes(const GridGeometry& geometry) {
  return BitMaps::bytesFor(geometry) + JumpPointBits::bytesFor(geometry);
}

}  // namespace

PlannerTraits JumpPoint::declaredTraits() {
  PlannerTraits traits;
  traits.name = "jump_point";
  traits.four_connected = false;
  traits.unit_diagonals = false;
  traits.cut_corners = false;
  traits.weights = false;
  traits.optimal = true;
  traits.repairs = true;
  return traits;
}

JumpPoint::JumpPoint() : Planner(declaredTraits()) {}

// On noise up to half of the cells are turns, and a search that looks at all of them needs a node,
// two places in the table and a share of the open list for each.
std::size_t JumpPoint::bytesFor(const GridGeometry& geometry) const {
  constexpr std::size_t kTurnBytes = sizeof(HashedNodes<std::uint32_t>::Node) + 12;
  return mapBytes(geometry) + geometry.size() / 2 * kTurnBytes;
}

void JumpPoint::doPrepare(const StopToken& stop) {
  maps_.build(map().bitMaps(stop), stop);
}

void JumpPoint::doUpdate(const CellRect& changed, const StopToken& stop) {
  maps_.update(map().bitMaps(stop), changed, stop);
}

template <class Scale>
std::optional<SearchResult> JumpPoint::searchFrom(HashedNodes<typename Scale::Key>& nodes,
                                                  const SearchRequest& request,
                                                  const StopToken& stop) {
  using Found = Search<Scale>;
  Found search(map().bitMaps(stop).rows, maps_, nodes, request, stop);
  SearchResult result;
  StopReason stopped = StopReason::NONE;
  const auto outcome = search.run(result, stopped);
  if (outcome == Found::Outcome::TOO_LARGE) return std::nullopt;
  result.status = Status::UNREACHABLE;
  if (stopped != StopReason::NONE) result.status = Stopped(stopped).status();
  if (outcome == Found::Outcome::FOUND) {
    result.status = Status::FOUND;
    search.trace(std::int64_t{map().minWeight()} * map().kernel(), result);
  }
  result.statistics.search_bytes = mapBytes(map().geometry()) + nodes.bytes();
  return result;
}

SearchResult JumpPoint::doSearch(const SearchRequest& request, const StopToken& stop) {
  // The estimate must fit beside the cost: no way is as long as a map's sides of 2^15 cells.
  const GridGeometry& geometry = map().geometry();
  if (std::max(geometry.width(), geometry.height()) <= 1 << 15)
    if (auto result = searchFrom<SmallScale>(nodes_, request, stop)) return std::move(*result);
  if (auto result = searchFrom<LargeScale>(large_nodes_, request, stop)) return std::move(*result);
  throw TooExpensive();
}

}  // namespace grid_path_planner::planners
