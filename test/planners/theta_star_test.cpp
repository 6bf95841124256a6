#include "planners/any_angle/theta_star.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/ascii_map.h"
#include "support/cost_maps.h"

namespace grid_path_planner::planners {

using base::Status;
using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::CostmapOptions;
using grid::Cell;

namespace {

using test::costsOf;

SearchResult thetaStarOn(const std::shared_ptr<const CostGrid>& map, Cell start, Cell goal) {
  LazyThetaStar planner;
  planner.prepare(map, StopToken());
  return planner.search({start, {goal}, false}, StopToken());
}

SearchResult thetaStarOn(const test::AsciiMap& picture) {
  return thetaStarOn(costsOf(picture.map), picture.start, picture.goal);
}

TEST(LazyThetaStar, CrossesOpenWaterInOneLine) {
  const SearchResult result = thetaStarOn(test::AsciiMap({"S......",  //
                                                          ".......",  //
                                                          "......G"}));
  EXPECT_EQ(result.cells, (std::vector<Cell>{{0, 0}, {6, 2}}));
  EXPECT_NEAR(result.costValue(), std::hypot(6, 2), 1e-12);
}

TEST(LazyThetaStar, TurnsOnlyAtCorners) {
  const SearchResult result = thetaStarOn(test::AsciiMap({"S..#...",  //
                                                          "...#...",  //
                                                          ".......",  //
                                                          "......G"}));
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_LE(result.cells.size(), 4u);
  EXPECT_LT(result.costValue(), 3.0 + 3.0 * std::sqrt(2.0)) << "what a grid path costs";
}

// navigation2#2520, #2690: crosses expensive cells although a path around them costs less.
TEST(LazyThetaStar, AvoidsExpensiveCells) {
  const test::AsciiMap picture({"........",  //
                                "S.????.G",  //
                                "..????.."});
  const SearchResult result = thetaStarOn(picture);
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_LT(result.costValue(), 10.0) << "straight through unknown cells: 50 a cell";
}

// navigation2#5863: a segment squeezes between two obstacles that touch at a corner.
TEST(LazyThetaStar, DoesNotSqueezeThroughACorner) {
  EXPECT_EQ(thetaStarOn(test::AsciiMap({"S#",  //
                                        "#G"}))
                .status,
            Status::UNREACHABLE);
}

// The query stamp wraps around after 16,383 queries.
// On a gentle potential the straight distance at the least weight says next to nothing: by it nearly
// all of the 8,000 cells were expanded.
TEST(LazyThetaStar, GoesAlongAGentleValley) {
  grid::Grid<CostGrid::Weight> weights(grid::GridGeometry(200, 40, 1.0), 5);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 200; ++column)
      weights[Cell{column, row}] = static_cast<CostGrid::Weight>(5 + std::abs(row - 20));
  weights[Cell{199, 39}] = 1;
  const auto map = test::costsOf(weights, costmap::MotionModel(), 1);
  const SearchResult result = thetaStarOn(map, {184, 20}, {4, 20});
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_NEAR(result.costValue(), 180 * 5, 1e-9);
  EXPECT_LT(result.statistics.expanded, 4000U);
}

TEST(LazyThetaStar, ALateQueryIsAnsweredLikeTheFirst) {
  const test::AsciiMap picture({"S.#.",  //
                                "...G"});
  const auto map = costsOf(picture.map);
  LazyThetaStar planner;
  planner.prepare(map, StopToken());
  const SearchRequest there{picture.start, {picture.goal}, false};
  const SearchRequest back{picture.goal, {picture.start}, false};
  const SearchResult first = planner.search(there, StopToken());
  for (int i = 0; i < 17000; ++i) {
    const SearchResult again = planner.search(i % 2 == 0 ? back : there, StopToken());
    ASSERT_EQ(again.status, Status::FOUND) << "query " << i;
    ASSERT_NEAR(again.costValue(), first.costValue(), 1e-12);
    if (i % 2 == 1) {
      ASSERT_EQ(again.cells, first.cells) << "query " << i;
    }
  }
}

TEST(LazyThetaStar, SaysWhatItCannotPlanWith) {
  CostmapOptions options;
  options.motion.connectivity = Connectivity::FOUR;
  const SearchResult result =
      thetaStarOn(costsOf(test::AsciiMap({"S.G"}).map, options), {0, 0}, {2, 0});
  EXPECT_EQ(result.status, Status::INVALID_REQUEST);
  EXPECT_EQ(result.message, "lazy_theta_star does not plan with connectivity 4, which a_star does");
}

}  // namespace
}  // namespace grid_path_planner::planners
