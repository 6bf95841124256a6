#include "planners/any_angle/turning_points.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "planners/core/steps.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::CostGrid, costmap::lineCostWithin, costmap::waypointOf;
using grid::Cell;

namespace {

using Cells = std::vector<Cell>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Less is not worth a move, and might be rounding.
constexpr double kGain = 1e-9;
constexpr int kRounds = 6;
constexpr int kFirstStep = 4;  // cells
constexpr int kMovesOfAStep = 4;
constexpr int kShortest = 4;  // cells, of a segment that is bent

double segmentCost(const CostGrid& map, Cell from, Cell to, double limit) {
  return lineCostWithin(map, nullptr, waypointOf(map, from), waypointOf(map, to), limit)
      .value_or(kInfinity);
}

class Tightening {
 public:
  Tightening(const CostGrid& map, const StopToken& stop) : map_(map), poll_(stop, 64) {}

  Cells run(Cells cells) {
    for (int round = 0; round < kRounds; ++round) {
      changed_ = false;
      cells = withPointsMoved(cells);
      cells = withSegmentsBent(cells);
      if (!changed_) break;
    }
    return cells;
  }

 private:
  // A turning point between two others, and what the two segments cost.
  struct Turn {
    Cell at;
    double cost;
  };

  double cost(Cell from, Cell to, double limit = kInfinity) {
    poll_();
    return segmentCost(map_, from, to, limit);
  }

  Cells withPointsMoved(const Cells& cells) {
    Cells moved = {cells.front()};
    for (std::size_t i = 1; i + 1 < cells.size(); ++i) {
      const Cell before = moved.back(), after = cells[i + 1];
      const double present = cost(before, cells[i]) + cost(cells[i], after);
      const double straight = cost(before, after, present);
      const bool unnecessary = straight < kInfinity && straight <= present;
      const Cell at =
          unnecessary ? cells[i] : lowest(before, {cells[i], present}, after, kFirstStep).at;
      changed_ = changed_ || unnecessary || at != cells[i];
      if (!unnecessary) moved.push_back(at);
    }
    if (cells.size() > 1) moved.push_back(cells.back());
    return moved;
  }

  Cells withSegmentsBent(const Cells& cells) {
    Cells bent = {cells.front()};
    for (std::size_t i = 1; i < cells.size(); ++i) {
      const Cell from = cells[i - 1], to = cells[i];
      const int length = std::max(std::abs(from.column - to.column), std::abs(from.row - to.row));
      if (length >= kShortest) bend(from, to, std::clamp(length / 8, 1, kFirstStep), bent);
      bent.push_back(to);
    }
    return bent;
  }

  void bend(Cell from, Cell to, int step, Cells& bent) {
    const Cell middle{(from.column + to.column) / 2, (from.row + to.row) / 2};
    const double straight = cost(from, to);
    const Turn turn = lowest(from, {middle, straight}, to, step);
    if (turn.cost == straight) return;
    bent.push_back(turn.at);
    changed_ = true;
  }

  // Hill climbing to lower costs from `turn`, in steps that halve.
  Turn lowest(Cell before, Turn turn, Cell after, int step) {
    for (; step > 0; step /= 2)
      for (int moves = 0; moves < kMovesOfAStep && move(before, turn, after, step); ++moves) {
      }
    return turn;
  }

  bool move(Cell before, Turn& turn, Cell after, int step) {
    for (const auto& direction : kSteps) {
      const Cell to{turn.at.column + step * direction.column, turn.at.row + step * direction.row};
      if (!map_.geometry().contains(to) || to == before || to == after) continue;
      const double first = cost(before, to, turn.cost);
      if (first >= turn.cost) continue;
      const double both = first + cost(to, after, turn.cost - first);
      if (both >= turn.cost * (1.0 - kGain)) continue;
      turn = {to, both};
      return true;
    }
    return false;
  }

  const CostGrid& map_;
  StopPoll poll_;
  bool changed_ = false;
};

}  // namespace

Cells tightened(const CostGrid& map, Cells cells, const StopToken& stop) {
  return Tightening(map, stop).run(std::move(cells));
}

double costOfTurningPoints(const CostGrid& map, const Cells& cells) {
  double sum = 0.0;
  for (std::size_t i = 1; i < cells.size(); ++i)
    sum += segmentCost(map, cells[i - 1], cells[i], kInfinity);
  return sum;
}

}  // namespace grid_path_planner::planners
