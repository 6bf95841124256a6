// Finds cells that may be inconsistent: neighbours whose g-values differ by more than the step
// between them costs. Compares two cells at a time.
//
//   InconsistencyScan scan(nodes, rect);
//   scan.forEachSuspect([&](Cell cell) { use(cell); });  // to be checked exactly
//
// Guaranteed: visits every cell of `rect` from which a step to the east, the north or the
// north-east, or the step from its eastern to its northern neighbour, costs less than the g-values
// of its ends differ, or leads to a cell without one. Visits a few others.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planners/replanning/backward_nodes.h"

namespace grid_path_planner::planners {

class InconsistencyScan {
 public:
  // Precondition: `rect` lies in the map of `nodes`, which outlives this.
  InconsistencyScan(const BackwardNodes& nodes, const grid::CellRect& rect);

  template <class Visit>
  void forEachSuspect(const Visit& visit) {
    fill(lines_[0], rect_.row);
    for (int row = rect_.row; row < rect_.row + rect_.height; ++row) {
      fill(lines_[1], row + 1);
      for (int first = 0; first < rect_.width; first += kTogether)
        if (suspect(static_cast<std::size_t>(first)))
          for (int i = first; i < std::min(first + kTogether, rect_.width); ++i)
            visit(grid::Cell{rect_.column + i, row});
      std::swap(lines_[0], lines_[1]);
    }
  }

 private:
  static constexpr int kTogether = 2;

  struct Line {
    std::vector<double> g;        // not a number: blocked or outside; infinite: none yet
    std::vector<double> weights;  // 0 where blocked or outside
  };

  void fill(Line& line, int row);
  // Whether one of the four steps of the cells from `first` on may be inconsistent.
  bool suspect(std::size_t first) const;

  const BackwardNodes& nodes_;
  grid::CellRect rect_;
  std::array<Line, 2> lines_;  // a row and the one to the north of it
};

}  // namespace grid_path_planner::planners
