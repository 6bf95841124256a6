#include "planners/core/natural_moves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "planners/core/steps.h"
#include "support/cost_maps.h"

namespace grid_path_planner::planners {

using costmap::CostGrid;
using costmap::ExactCost;
using costmap::stepAllowed;
using costmap::stepCost;
using grid::Cell;
using grid::Grid;
using grid::GridGeometry;

namespace {

constexpr unsigned kStepEast = 0, kStepNorthEast = 4;

unsigned naturalIn(const Window& window, unsigned step) {
  return naturalMoves(window) >> (8 * step) & 255U;
}

TEST(NaturalMoves, FollowTheCanonicalOrderInTheOpen) {
  for (const CostGrid::Weight weight : {1, 40, 65535}) {
    Window window;
    window.fill(weight);
    for (unsigned step = 0; step < 8; ++step)
      EXPECT_EQ(naturalIn(window, step), kNaturalInTheOpen[step]) << "step " << step;
  }
}

// Row 0 first: north, where the rows grow, is the last line.
TEST(NaturalMoves, TurnPastACorner) {
  EXPECT_EQ(naturalIn({1, 1, 1,  //
                       1, 1, 1,  //
                       0, 1, 1},
                      kStepEast),
            1U << 0 | 1U << 1 | 1U << 4)
      << "north and north-east too, which the blocked cell hides from the cell before";
}

TEST(NaturalMoves, EndBeforeAWall) {
  EXPECT_EQ(naturalIn({1, 1, 0,  //
                       1, 1, 0,  //
                       1, 1, 0},
                      kStepEast),
            0U);
}

TEST(NaturalMoves, GoAroundAnExpensiveMiddle) {
  EXPECT_EQ(naturalIn({1, 1, 1,  //
                       1, 9, 1,  //
                       1, 1, 1},
                      kStepNorthEast),
            0U);
}

TEST(NaturalMoves, GoStraightBeforeWeightsIncrease) {
  const Window downhill = {3, 2, 1,  //
                           3, 2, 1,  //
                           3, 2, 1};
  EXPECT_EQ(naturalIn(downhill, kStepEast), 1U << 0 | 1U << 4 | 1U << 7)
      << "3 + 2 root 2 is less than 3 root 2 + 2";
}

TEST(NaturalMoves, UniteThoseOfSeveralSteps) {
  Window window;
  window.fill(1);
  const NaturalMoves steps = naturalMoves(window);
  EXPECT_EQ(naturalAfter(steps, 0), 0U);
  EXPECT_EQ(naturalAfter(steps, 1U << 0 | 1U << 4), 1U << 0 | 1U << 1 | 1U << 4);
  EXPECT_EQ(naturalAfter(steps, 255), 255U);
}

// All paths inside a window that visit no cell twice, one after the other.
class EveryPath {
 public:
  explicit EveryPath(const Window& window) : map_(mapOf(window)) {}

  std::vector<unsigned> canonical(Cell from, Cell to) {
    best_.reset();
    to_ = to;
    visited_ = {from};
    path_.clear();
    extend(ExactCost{});
    return best_ ? best_path_ : std::vector<unsigned>{};
  }
  bool allowed(Cell from, unsigned step) const {
    return stepAllowed(map_, from, after(from, step));
  }
  static Cell after(Cell cell, unsigned step) {
    return {cell.column + kSteps[step].column, cell.row + kSteps[step].row};
  }

 private:
  static CostGrid mapOf(const Window& window) {
    Grid<CostGrid::Weight> weights(GridGeometry(3, 3, 1.0),
                                   std::vector<CostGrid::Weight>(window.begin(), window.end()));
    return test::costMap(weights);
  }

  // Diagonal steps first: so of equal costs the path that is found first is the canonical one.
  void extend(const ExactCost& cost) {
    if (best_ && *best_ < cost) return;
    const Cell at = visited_.back();
    if (at == to_) {
      if (best_ && !(cost < *best_)) return;
      best_ = cost;
      best_path_ = path_;
      return;
    }
    for (const unsigned step : {4U, 5U, 6U, 7U, 0U, 1U, 2U, 3U}) {
      const Cell next = after(at, step);
      if (!allowed(at, step)) continue;
      if (std::find(visited_.begin(), visited_.end(), next) != visited_.end()) continue;
      visited_.push_back(next);
      path_.push_back(step);
      extend(cost + stepCost(map_, at, next));
      path_.pop_back();
      visited_.pop_back();
    }
  }

  CostGrid map_;
  Cell to_;
  std::vector<Cell> visited_;
  std::vector<unsigned> path_;
  std::vector<unsigned> best_path_;
  std::optional<ExactCost> best_;
};

TEST(NaturalMovesLaw, AreThoseOfTheFirstOfTheLeastCostPaths) {
  std::mt19937 random(1604);
  const Cell middle{1, 1};
  for (int trial = 0; trial < 150; ++trial) {
    const unsigned largest[] = {1, 2, 3, 65535};
    Window window;
    for (auto& weight : window)
      weight =
          static_cast<CostGrid::Weight>(random() % 6 == 0 ? 0 : 1 + random() % largest[trial % 4]);
    EveryPath paths(window);
    const NaturalMoves steps = naturalMoves(window);
    for (unsigned d = 0; d < 8; ++d)
      for (unsigned e = 0; e < 8; ++e) {
        const Cell from{1 - kSteps[d].column, 1 - kSteps[d].row};
        const bool legal = paths.allowed(from, d) && paths.allowed(middle, e);
        const bool natural =
            legal && paths.canonical(from, EveryPath::after(middle, e)) == std::vector{d, e};
        EXPECT_EQ((steps >> (8 * d + e) & 1U) != 0, natural)
            << "trial " << trial << ", step " << e << " after " << d;
      }
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
