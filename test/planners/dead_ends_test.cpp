#include "planners/jump_point/dead_ends.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "planners/core/steps.h"
#include "support/cost_maps.h"
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

// Of the cells of the map, whose window has a border of one cell.
std::vector<std::uint8_t> liveSteps(DeadBranches& dead, const Branches& branches,
                                    const CostGrid& map, int depth) {
  const int width = map.geometry().width(), height = map.geometry().height();
  dead.reset(width + 2, height + 2);
  const auto at = [width](Cell cell) {
    return std::uint32_t(cell.row + 1) * std::uint32_t(width + 2) + std::uint32_t(cell.column + 1);
  };
  for (const Cell cell : test::cellsOf(map))
    if (map.passable(cell))
      dead.set(at(cell), branches.natural[map.geometry().index(cell).value()]);
  const std::vector<std::uint8_t>& of_window = dead.liveSteps(depth);
  std::vector<std::uint8_t> live;
  for (const Cell cell : test::cellsOf(map)) live.push_back(of_window[at(cell)]);
  return live;
}

TEST(DeadBranches, EndWhereNoStepIsNatural) {
  EXPECT_EQ(deadAfter(0), 255U);
  EXPECT_EQ(deadAfter(0x8000000000000001U), 126U);
  EXPECT_EQ(deadAfter(~NaturalMoves{0}), 0U);
}

TEST(DeadBranchesLaw, AreTheStepsThatLeadNowhereElse) {
  std::mt19937 random(12);
  DeadBranches dead;
  for (int trial = 0; trial < 60; ++trial) {
    const CostGrid map = test::randomCosts(random, 14, {});
    const int depth = int(random() % 5);
    const Branches branches(map);
    const std::vector<std::uint8_t> live = liveSteps(dead, branches, map, depth);
    for (std::uint32_t i = 0; i < live.size(); ++i)
      for (unsigned step = 0; step < 8; ++step) {
        const Cell cell = map.geometry().cell(CellIndex(i));
        const Cell to{cell.column + kSteps[step].column, cell.row + kSteps[step].row};
        if (!map.passable(cell) || !map.passable(to)) continue;
        EXPECT_EQ((live[i] >> step & 1U) == 0, branches.ends(to, step, depth))
            << "trial " << trial << ", step " << step << " from " << cell << ", depth " << depth;
      }
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
