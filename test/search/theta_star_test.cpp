#include "grid_path_planner/search/theta_star.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_path_planner/search/a_star.h"
#include "support/ascii_map.h"
#include "support/costs_of.h"
#include "support/random_map.h"

namespace grid_path_planner {
namespace {

using test::costsOf;

PlanResult planOn(const std::shared_ptr<const CostGrid>& map, Cell start, Cell goal,
                  bool lazy = false) {
  ThetaStar planner = lazy ? ThetaStar::lazy() : ThetaStar();
  planner.prepare(map, StopToken());
  return planner.plan({start, {goal}, false}, StopToken());
}

PlanResult planOn(const test::AsciiMap& picture) {
  return planOn(costsOf(picture.map), picture.start, picture.goal);
}

TEST(ThetaStar, CrossesOpenWaterInOneLine) {
  const PlanResult result = planOn(test::AsciiMap({"S......",  //
                                                   ".......",  //
                                                   "......G"}));
  EXPECT_EQ(result.cells, (std::vector<Cell>{{0, 0}, {6, 2}}));
  EXPECT_NEAR(result.costValue(), std::hypot(6, 2), 1e-12);
}

TEST(ThetaStar, TurnsOnlyAtCorners) {
  const PlanResult result = planOn(test::AsciiMap({"S..#...",  //
                                                   "...#...",  //
                                                   ".......",  //
                                                   "......G"}));
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_LE(result.cells.size(), 4u);
  EXPECT_LT(result.costValue(), 3.0 + 3.0 * std::sqrt(2.0)) << "what a grid path costs";
}

// navigation2#2520, #2690: crosses dear cells despite a cheaper detour.
TEST(ThetaStar, GoesAroundWhatIsDear) {
  const test::AsciiMap picture({"........",  //
                                "S.????.G",  //
                                "..????.."});
  const PlanResult result = planOn(picture);
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_LT(result.costValue(), 10.0) << "straight through unknown cells: 50 a cell";
}

// navigation2#5863: a segment squeezes between two obstacles that touch at a corner.
TEST(ThetaStar, DoesNotSqueezeThroughACorner) {
  EXPECT_EQ(planOn(test::AsciiMap({"S#",  //
                                   "#G"}))
                .status,
            Status::UNREACHABLE);
}

TEST(LazyThetaStar, CrossesOpenWaterAndGoesAroundWhatIsDear) {
  const test::AsciiMap open({"S......",  //
                             ".......",  //
                             "......G"});
  EXPECT_EQ(planOn(costsOf(open.map), open.start, open.goal, true).cells,
            (std::vector<Cell>{{0, 0}, {6, 2}}));
  const test::AsciiMap dear({"........",  //
                             "S.????.G",  //
                             "..????.."});
  EXPECT_LT(planOn(costsOf(dear.map), dear.start, dear.goal, true).costValue(), 10.0);
}

// What is found on trust is no better than what was looked at, and hardly worse.
TEST(LazyThetaStarLaw, CostsAboutWhatThetaStarCosts) {
  std::mt19937 random(2011);
  double eager = 0.0, lazy = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 50, {}));
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    const PlanResult a = planOn(map, start, goal);
    const PlanResult b = planOn(map, start, goal, true);
    ASSERT_EQ(a.status, b.status);
    if (a.status != Status::FOUND || a.costValue() == 0.0) continue;
    EXPECT_LT(b.costValue(), 1.2 * a.costValue()) << "trial " << trial;
    eager += 1.0;
    lazy += b.costValue() / a.costValue();
  }
  EXPECT_GT(eager, 80.0);
  EXPECT_LT(lazy, 1.02 * eager);
}

// The numbers of queries begin anew after 16,383.
TEST(ThetaStar, ALateQueryIsAnsweredLikeTheFirst) {
  const test::AsciiMap picture({"S.#.",  //
                                "...G"});
  const auto map = costsOf(picture.map);
  ThetaStar planner;
  planner.prepare(map, StopToken());
  const PlanRequest there{picture.start, {picture.goal}, false};
  const PlanRequest back{picture.goal, {picture.start}, false};
  const PlanResult first = planner.plan(there, StopToken());
  for (int i = 0; i < 17000; ++i) {
    const PlanResult again = planner.plan(i % 2 == 0 ? back : there, StopToken());
    ASSERT_EQ(again.status, Status::FOUND) << "query " << i;
    ASSERT_NEAR(again.costValue(), first.costValue(), 1e-12);
    if (i % 2 == 1) {
      ASSERT_EQ(again.cells, first.cells) << "query " << i;
    }
  }
}

TEST(ThetaStar, SaysWhatItCannotPlanWith) {
  TerrainOptions options;
  options.motion.connectivity = Connectivity::FOUR;
  const PlanResult result = planOn(costsOf(test::AsciiMap({"S.G"}).map, options), {0, 0}, {2, 0});
  EXPECT_EQ(result.status, Status::INVALID_REQUEST);
  EXPECT_EQ(result.message, "theta_star does not plan with connectivity 4, which a_star does");
}

// Never below the straight line; together shorter than grid paths, which is what it is for.
TEST(ThetaStarLaw, LiesBetweenTheStraightLineAndTheGrid) {
  std::mt19937 random(2010);
  double any_angle = 0.0, grid = 0.0;
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto map = costsOf(test::randomOccupancy(random, 40, 0.1, 0.0));
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    const PlanResult result = planOn(map, start, goal);
    AStar a_star;
    a_star.prepare(map, StopToken());
    const PlanResult steps = a_star.plan({start, {goal}, false}, StopToken());
    ASSERT_EQ(result.status, steps.status);
    if (result.status != Status::FOUND) continue;
    ++found;
    const double line = std::hypot(start.column - goal.column, start.row - goal.row);
    EXPECT_GE(result.costValue(), line * (1.0 - 1e-12));
    EXPECT_LE(result.costValue(), steps.costValue() * (1.0 + 1e-12)) << "trial " << trial;
    any_angle += result.costValue();
    grid += steps.costValue();
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(any_angle, 0.98 * grid);
}

}  // namespace
}  // namespace grid_path_planner
