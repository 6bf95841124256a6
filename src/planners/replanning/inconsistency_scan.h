// A quick look at labels side by side, for those that differ by more than the step between them.
//
//   InconsistencyScan lines(labels, rect);
//   lines.forEachSuspect([&](Cell cell) { use(cell); });  // look closer
//
// Tells of every cell of `rect` from which a step to the east, the north or the north-east, or one
// from its eastern neighbour to its northern one, may be less than the labels of its ends differ,
// or lead where there is no label; and of a few others. Compares two cells at a time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planners/replanning/backward_nodes.h"

namespace grid_path_planner::planners {

class InconsistencyScan {
 public:
  // Precondition: `rect` lies in the map of `labels`, which outlives this.
  InconsistencyScan(const BackwardNodes& labels, const grid::CellRect& rect);

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
    std::vector<double> labels;   // not a number: blocked or outside; infinite: not labelled
    std::vector<double> weights;  // 0 where blocked or outside
  };

  void fill(Line& line, int row);
  // Whether there is one among the four pairs of each of the cells from `first` on.
  bool suspect(std::size_t first) const;

  const BackwardNodes& labels_;
  grid::CellRect rect_;
  std::array<Line, 2> lines_;  // a row and the one to the north of it
};

}  // namespace grid_path_planner::planners
