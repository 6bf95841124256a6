#include "planners/rectangles/rectangle_route.h"

#include <gtest/gtest.h>

#include "grid_path_planner/planners/decomposition.h"
#include "support/free_cells.h"

namespace grid_path_planner::planners {

using base::StopToken;
using grid::GridGeometry;

namespace {

// The worked example of the published R-map; its rectangles count from 1, ours from 0.
class PublishedExample : public ::testing::Test {
 protected:
  static RectangleGraph make() {
    const auto free = test::publishedExample();
    return RectangleGraph(free.geometry(), largestFirst(test::bitMapsOf(free), {}, StopToken()),
                          Touching::BORDERS);
  }

  double weight(RectangleWeight weight, std::uint32_t from, std::uint32_t to) const {
    for (const Connection& step : map_.connections().of(from - 1))
      if (step.to == to - 1) return stepWeight(map_, weight, from - 1, step);
    ADD_FAILURE() << from << " and " << to << " do not touch";
    return 0.0;
  }

  RectangleGraph map_ = make();
};

TEST_F(PublishedExample, HasThePublishedConnections) {
  std::vector<std::uint32_t> neighbours;
  for (const Connection& step : map_.connections().of(0)) neighbours.push_back(step.to + 1);
  EXPECT_EQ(neighbours, (std::vector<std::uint32_t>{7, 8, 9}));
}

TEST_F(PublishedExample, HasThePublishedWeights) {
  EXPECT_EQ(weight(RectangleWeight::AREA, 1, 7), 7.0);
  EXPECT_EQ(weight(RectangleWeight::AREA, 7, 1), 1.0);
  EXPECT_EQ(weight(RectangleWeight::BORDER, 1, 7), 1.0);
  EXPECT_NEAR(weight(RectangleWeight::BORDER, 3, 5), 1.0, 1e-12);
  EXPECT_NEAR(weight(RectangleWeight::DISTANCE, 1, 7), 2.0616, 5e-5);
  EXPECT_NEAR(weight(RectangleWeight::DISTANCE, 1, 8), 4.0311, 5e-5);
  EXPECT_NEAR(weight(RectangleWeight::DISTANCE, 2, 4), 3.9051, 5e-5);
  EXPECT_NEAR(weight(RectangleWeight::DISTANCE, 3, 5), 4.1231, 5e-5);
  EXPECT_NEAR(weight(RectangleWeight::DISTANCE, 7, 9), 1.1180, 5e-5);
  EXPECT_NEAR(weight(RectangleWeight::CONNECTIONS, 1, 7), 0.3333, 5e-5);
  EXPECT_NEAR(weight(RectangleWeight::CONNECTIONS, 1, 8), 0.5, 5e-5);
  EXPECT_NEAR(weight(RectangleWeight::CONNECTIONS, 3, 5), 1.0, 5e-5);
  EXPECT_NEAR(weight(RectangleWeight::CONNECTIONS, 2, 6), 1.0, 5e-5);
}

TEST_F(PublishedExample, EveryWeightFindsTheOnlyPath) {
  // From rectangle 5 at the bottom to rectangle 6 at the top right.
  for (const auto& choice : choicesOf(RectangleWeight{})) {
    RectangleSearch search;
    const RectangleRoute route = search.find(map_, choice.second, {0, 9}, {9, 0}, StopToken());
    ASSERT_TRUE(route.found) << choice.first;
    EXPECT_EQ(route.first, 4U);
    EXPECT_EQ(route.steps.front().to, 2U);
    EXPECT_EQ(route.steps.back().to, 5U);
  }
}

TEST_F(PublishedExample, MiddlesOfBordersAreNeighbouringCells) {
  for (std::uint32_t i = 0; i < map_.rectangles().size(); ++i)
    for (const Connection& step : map_.connections().of(i)) {
      const auto [outward, inward] = middleOf(map_.rectangles()[i], step);
      EXPECT_TRUE(map_.rectangles()[i].contains(outward));
      EXPECT_TRUE(map_.rectangles()[step.to].contains(inward));
      EXPECT_EQ(std::abs(outward.column - inward.column) + std::abs(outward.row - inward.row), 1);
    }
}

TEST(RectangleSearch, DoesNotFindWhatIsNotConnected) {
  const RectangleGraph map(GridGeometry(3, 3, 1.0), {{0, 0, 1, 1}, {1, 1, 1, 1}},
                           Touching::BORDERS);
  for (const auto& choice : choicesOf(RectangleWeight{})) {
    RectangleSearch search;
    EXPECT_FALSE(search.find(map, choice.second, {0, 0}, {1, 1}, StopToken()).found);
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
