#include "planners/jump_point/dead_ends.h"

#include <gtest/gtest.h>

#include <random>

#include "planners/core/steps.h"
#include "support/random_map.h"

namespace grid_path_planner::planners {

using costmap::CostGrid;
using grid::Cell;
using grid::CellIndex;

namespace {

class Branches {
 public:
  explicit Branches(const CostGrid& map) : map_(map) {
    for (int row = 0; row < map.geometry().height(); ++row)
      for (int column = 0; column < map.geometry().width(); ++column)
        natural.push_back(naturalMoves(windowAt(map, {column, row})));
  }

  // Whether everything natural after the step into the cell ends within `depth` steps.
  bool ends(Cell cell, unsigned step, int depth) const {
    const NaturalMoves steps = natural[map_.geometry().index(cell).value()];
    for (unsigned next = 0; next < 8; ++next) {
      if ((steps >> (8 * step + next) & 1U) == 0) continue;
      if (depth == 0) return false;
      if (!ends({cell.column + kSteps[next].column, cell.row + kSteps[next].row}, next, depth - 1))
        return false;
    }
    return true;
  }

  std::vector<NaturalMoves> natural;

 private:
  const CostGrid& map_;
};

TEST(DeadBranches, EndWhereNoStepIsNatural) {
  EXPECT_EQ(deadAfter(0), 255U);
  EXPECT_EQ(deadAfter(0x8000000000000001U), 126U);
  EXPECT_EQ(deadAfter(~NaturalMoves{0}), 0U);
}

TEST(DeadBranchesLaw, AreTheStepsThatLeadNowhereElse) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 60; ++trial) {
    const CostGrid map = test::randomCosts(random, 14, {});
    const int depth = int(random() % 5);
    const Branches branches(map);
    const auto live =
        liveSteps(branches.natural, map.geometry().width(), map.geometry().height(), depth);
    for (std::uint32_t i = 0; i < live.size(); ++i)
      for (unsigned step = 0; step < 8; ++step) {
        const Cell cell = map.geometry().cell(CellIndex(i));
        const Cell to{cell.column + kSteps[step].column, cell.row + kSteps[step].row};
        if (!map.geometry().contains(to)) continue;
        EXPECT_EQ((live[i] >> step & 1U) == 0, branches.ends(to, step, depth))
            << "trial " << trial << ", step " << step << " from " << cell << ", depth " << depth;
      }
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
