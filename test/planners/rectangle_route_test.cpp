#include "planners/rectangles/rectangle_route.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

grid::Cell cellAt(const Eigen::Vector2d& point) {
  return {static_cast<int>(point.x()), static_cast<int>(point.y())};
}

using Numbers = std::vector<std::uint32_t>;

TEST_F(PublishedExample, HasThePublishedConnections) {
  const std::vector<Numbers> published = {{7, 8, 9}, {4, 6, 7}, {5, 8, 10}, {2, 10}, {3},
                                          {2},       {1, 2, 9}, {1, 3},     {1, 7},  {3, 4}};
  for (std::uint32_t i = 0; i < published.size(); ++i) {
    Numbers neighbours;
    for (const Connection& step : map_.connections().of(i)) neighbours.push_back(step.to + 1);
    EXPECT_EQ(neighbours, published[i]) << "of rectangle " << i + 1;
  }
}

// By hand, from the corners of the ten rectangles. Each border is one cell long.
TEST_F(PublishedExample, HasThePublishedWeights) {
  struct Pair {
    std::uint32_t a, b;
    double distance;          // between the centres
    double a_count, b_count;  // of connections
  };
  const std::vector<Pair> pairs = {
      {1, 7, 2.0616, 3, 3}, {1, 8, 4.0311, 3, 2},  {1, 9, 2.1213, 3, 2}, {2, 4, 3.9051, 3, 2},
      {2, 6, 3.3541, 3, 1}, {2, 7, 2.9155, 3, 3},  {3, 5, 4.1231, 3, 1}, {3, 8, 3.1623, 3, 2},
      {3, 10, 2.5, 3, 2},   {4, 10, 2.2361, 2, 2}, {7, 9, 1.1180, 3, 2}};
  for (const Pair& pair : pairs) {
    SCOPED_TRACE(std::to_string(pair.a) + " and " + std::to_string(pair.b));
    EXPECT_EQ(weight(RectangleWeight::AREA, pair.a, pair.b), pair.b);
    EXPECT_EQ(weight(RectangleWeight::AREA, pair.b, pair.a), pair.a);
    EXPECT_EQ(weight(RectangleWeight::BORDER, pair.a, pair.b), 1.0);
    EXPECT_EQ(weight(RectangleWeight::BORDER, pair.b, pair.a), 1.0);
    EXPECT_NEAR(weight(RectangleWeight::DISTANCE, pair.a, pair.b), pair.distance, 5e-5);
    EXPECT_NEAR(weight(RectangleWeight::DISTANCE, pair.b, pair.a), pair.distance, 5e-5);
    EXPECT_EQ(weight(RectangleWeight::CONNECTIONS, pair.a, pair.b), 1.0 / pair.b_count);
    EXPECT_EQ(weight(RectangleWeight::CONNECTIONS, pair.b, pair.a), 1.0 / pair.a_count);
  }
}

// Between the largest and the third rectangle two routes lead; the published one has fewer steps.
TEST_F(PublishedExample, TakesThePublishedRoutes) {
  const auto routeTo = [&](RectangleWeight weight, grid::Cell goal) {
    RectangleSearch search;
    const RectangleRoute route = search.find(map_, weight, {0, 0}, goal, StopToken());
    Numbers numbers = {route.first + 1};
    for (const Connection& step : route.steps) numbers.push_back(step.to + 1);
    return numbers;
  };
  for (const auto& choice : choicesOf(RectangleWeight{}))
    EXPECT_EQ(routeTo(choice.second, {5, 8}), (Numbers{1, 8, 3})) << choice.first;
  EXPECT_EQ(routeTo(RectangleWeight::AREA, {8, 4}), (Numbers{1, 7, 2, 4}));
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
      const BorderMiddle middle = middleOf(map_.rectangles()[i], step);
      EXPECT_TRUE(map_.rectangles()[i].contains(cellAt(middle.outward)));
      EXPECT_TRUE(map_.rectangles()[step.to].contains(cellAt(middle.inward)));
      EXPECT_EQ((middle.inward - middle.outward).norm(), 1.0);
    }
}

// Published for the step from 1 to 7: (2, 4) and (3, 4), where the first cell's centre is (1, 1).
TEST_F(PublishedExample, HasThePublishedWaypoints) {
  const Connection step = *map_.connections().of(0).begin();
  ASSERT_EQ(step.to, 6U);
  const BorderMiddle middle = middleOf(map_.rectangles()[0], step);
  EXPECT_EQ(middle.outward, Eigen::Vector2d(1.5, 3.5));
  EXPECT_EQ(middle.inward, Eigen::Vector2d(2.5, 3.5));
}

TEST(BorderMiddle, OfAnEvenNumberOfCellsLiesBetweenTwo) {
  const BorderMiddle middle = middleOf({0, 0, 2, 6}, {1, Side::EAST, 1, 4});
  EXPECT_EQ(middle.outward, Eigen::Vector2d(1.5, 3.0));
  EXPECT_EQ(middle.inward, Eigen::Vector2d(2.5, 3.0));
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
