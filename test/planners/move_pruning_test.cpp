#include "planners/core/move_pruning.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::costOfSteps;
using costmap::DiagonalCost;
using costmap::ExactCost;
using costmap::MotionModel;
using costmap::stepAllowed;
using grid::Cell;
using grid::CellIndex;
using grid::Grid;
using grid::GridGeometry;
using test::costMap;

namespace {

constexpr unsigned kEast = 0, kNorth = 1, kWest = 2, kSouth = 3, kNorthEast = 4, kSouthEast = 7;

std::uint32_t bits(const std::vector<unsigned>& steps) {
  std::uint32_t all = 0;
  for (const unsigned step : steps) all |= 1U << step;
  return all;
}

// North is the next line.
std::uint32_t afterInTheMiddle(const std::vector<std::string>& lines, unsigned step) {
  MovePruning moves;
  moves.build(costMap(lines), StopToken());
  return moves.after(1U << step, 4);
}

TEST(MovePruning, GoesStraightOnInTheOpen) {
  const std::vector<std::string> open = {"...", "...", "..."};
  EXPECT_EQ(afterInTheMiddle(open, kEast), bits({kEast}));
  EXPECT_EQ(afterInTheMiddle(open, kSouth), bits({kSouth}));
  EXPECT_EQ(afterInTheMiddle(open, kNorthEast), bits({kNorthEast, kNorth, kEast}));
}

TEST(MovePruning, TurnsAroundBlockedCells) {
  EXPECT_EQ(afterInTheMiddle({"...", "...", "#.."}, kEast), bits({kEast, kNorth, 4}));
  EXPECT_EQ(afterInTheMiddle({"#..", "...", "..."}, kEast), bits({kEast, kSouth, kSouthEast}));
  EXPECT_EQ(afterInTheMiddle({"...", "..#", "#.."}, kEast), bits({kNorth}));
}

TEST(MovePruning, TriesMoreWhereWeightsDiffer) {
  for (const Cell step : kSteps) {
    std::vector<std::string> lines(3, "...");
    lines[static_cast<std::size_t>(1 + step.row)][static_cast<std::size_t>(1 + step.column)] = '?';
    EXPECT_EQ(afterInTheMiddle(lines, kEast), bits({kEast, kNorth, kSouth, 4, 7})) << step;
  }
}

TEST(MovePruning, TriesAllFromTheStart) {
  MovePruning moves;
  moves.build(costMap({"...", "...", "..."}), StopToken());
  EXPECT_EQ(moves.after(0, 4), 0xFFu);
  moves.build(costMap({"...", "..?", "..."}), StopToken());
  EXPECT_EQ(moves.after(0, 4), 0xFFu);
}

TEST(MovePruning, FindsMovesThatAnotherStepLeftOut) {
  MovePruning moves;
  moves.build(costMap({"...", "...", "..."}), StopToken());
  EXPECT_TRUE(moves.missing(bits({kEast}), kNorth, 4));
  EXPECT_FALSE(moves.missing(bits({kNorthEast}), kNorth, 4));
  EXPECT_FALSE(moves.missing(bits({kEast}), kWest, 4)) << "back is never worth it";
}

CostGrid randomSparseCosts(std::mt19937& random, int largest_side) {
  MotionModel motion;
  motion.connectivity = random() % 3 == 0 ? Connectivity::FOUR : Connectivity::EIGHT;
  motion.diagonal_cost = random() % 3 == 0 ? DiagonalCost::UNIT : DiagonalCost::SQRT2;
  motion.cut_corners = random() % 3 == 0;
  const GridGeometry geometry(1 + static_cast<int>(random() % largest_side),
                              1 + static_cast<int>(random() % largest_side), 1.0);
  Grid<CostGrid::Weight> weights(geometry, 3);
  const unsigned rarity = 2 + random() % 30;
  for (CostGrid::Weight& weight : weights.values())
    if (random() % rarity == 0) weight = static_cast<CostGrid::Weight>(random() % 3 * 32700);
  return costMap(weights, motion);
}

TEST(MovePruningLaw, TheStepsFromACellAreThoseThatAreAllowed) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const CostGrid map = randomSparseCosts(random, 30);
    MovePruning moves;
    moves.build(map, StopToken());
    StepMasks masks;
    masks.build(map, StopToken());
    for (std::uint32_t index = 0; index < map.geometry().size(); ++index) {
      const Cell cell = map.geometry().cell(CellIndex(index));
      std::uint32_t allowed = 0;
      for (unsigned step = 0; step < kSteps.size(); ++step)
        if (stepAllowed(map, cell,
                        {cell.column + kSteps[step].column, cell.row + kSteps[step].row}))
          allowed |= 1U << step;
      ASSERT_EQ(moves.from(index), allowed) << "trial " << trial << " cell " << cell;
      ASSERT_EQ(masks[index], allowed) << "trial " << trial << " cell " << cell;
    }
  }
}

Cell after(Cell cell, unsigned step) {
  return {cell.column + kSteps[step].column, cell.row + kSteps[step].row};
}

// The steps at the end of a least-cost path to each cell, as a mask; `least`: the costs.
std::vector<std::uint32_t> leastSteps(const CostGrid& map,
                                      const std::vector<std::optional<ExactCost>>& least) {
  std::vector<std::uint32_t> all(least.size(), 0);
  for (std::uint32_t index = 0; index < all.size(); ++index)
    for (unsigned step = 0; least[index] && step < kSteps.size(); ++step) {
      const Cell from = map.geometry().cell(CellIndex(index)), to = after(from, step);
      if (!stepAllowed(map, from, to)) continue;
      const std::uint32_t next = map.geometry().index(to).value();
      if (*least[index] + costOfSteps(map, {from, to}) == *least[next]) all[next] |= 1U << step;
    }
  return all;
}

// Whether a step is tried from a cell whichever of `steps` it is expanded by.
bool isAlwaysTried(const MovePruning& moves, std::uint32_t index, std::uint32_t steps,
                   unsigned step) {
  bool tried = (moves.after(0, index) >> step & 1U) != 0;
  for (unsigned by = 0; by < kSteps.size(); ++by)
    if ((steps >> by & 1U) != 0) tried = tried && (moves.after(1U << by, index) >> step & 1U) != 0;
  return tried;
}

// So a search need not expand a cell again by another step of equal cost.
TEST(MovePruningLaw, AStepOfLeastCostToEachCellIsTriedWhicheverStepLedToTheOneBefore) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 400; ++trial) {
    const CostGrid map =
        trial % 2 == 0 ? randomSparseCosts(random, 16) : test::randomCosts(random, 16, {});
    const Cell start = test::randomCell(random, map.geometry());
    if (!map.passable(start)) continue;
    const auto least = test::referenceCosts(map, start);
    const auto steps = leastSteps(map, least);
    MovePruning moves;
    moves.build(map, StopToken());
    for (std::uint32_t index = 0; index < steps.size(); ++index) {
      const Cell cell = map.geometry().cell(CellIndex(index));
      bool is_reached = !least[index] || cell == start;
      for (unsigned step = 0; step < kSteps.size(); ++step) {
        if ((steps[index] >> step & 1U) == 0) continue;
        const std::uint32_t before =
            map.geometry()
                .index({cell.column - kSteps[step].column, cell.row - kSteps[step].row})
                .value();
        is_reached = is_reached || isAlwaysTried(moves, before, steps[before], step);
      }
      ASSERT_TRUE(is_reached) << "trial " << trial << " cell " << cell;
    }
  }
}

// Wherever a cell lies among the eight that are looked at together, and at the border.
TEST(MovePruningLaw, BlockedCellsAroundTheMapChangeNothing) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 300; ++trial) {
    const CostGrid map = randomSparseCosts(random, 30);
    const Cell shift{1 + static_cast<int>(random() % 9), 1 + static_cast<int>(random() % 3)};
    const GridGeometry larger(map.geometry().width() + 18, map.geometry().height() + 4, 1.0);
    Grid<CostGrid::Weight> weights(larger, CostGrid::kBlocked);
    const auto inLarger = [&](Cell cell) {
      return Cell{cell.column + shift.column, cell.row + shift.row};
    };
    for (std::uint32_t index = 0; index < map.geometry().size(); ++index) {
      const Cell cell = map.geometry().cell(CellIndex(index));
      weights[inLarger(cell)] = map.weight(cell);
    }
    MovePruning moves, larger_moves;
    moves.build(map, StopToken());
    larger_moves.build(costMap(weights, map.motion()), StopToken());
    for (std::uint32_t index = 0; index < map.geometry().size(); ++index) {
      const Cell cell = map.geometry().cell(CellIndex(index));
      for (std::uint32_t step = 0; step < 8; ++step)
        ASSERT_EQ(moves.after(1U << step, index),
                  larger_moves.after(1U << step, larger.index(inLarger(cell)).value()))
            << "trial " << trial << " cell " << cell;
    }
  }
}

// A cell whose weight changes, changes the kinds around it, at the border of the map too.
TEST(MovePruningLaw, AnUpdateIsLikeABuild) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const CostGrid before = randomSparseCosts(random, 30);
    Grid<CostGrid::Weight> weights = before.weights();
    const Cell changed = test::randomCell(random, before.geometry());
    weights[changed] = static_cast<CostGrid::Weight>(random() % 3);
    const CostGrid after(weights, before.classes(), before.motion());
    MovePruning updated, fresh;
    updated.build(before, StopToken());
    updated.update(after, {changed.column, changed.row, 1, 1}, StopToken());
    fresh.build(after, StopToken());
    for (std::uint32_t index = 0; index < weights.values().size(); ++index)
      for (std::uint32_t step = 0; step < 8; ++step)
        ASSERT_EQ(updated.after(1U << step, index), fresh.after(1U << step, index));
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
