// ~cost_to_go and ~cost_to_go_image of small maps.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "ros/planning/shown/cost_to_go_publisher.h"
#include "support/ascii_map.h"

namespace grid_path_planner::nodes {

using base::StopToken;
using costmap::CostGrid;
using costmap::CostmapBuilder;
using costmap::CostmapOptions;
using grid::Cell;
using planners::CostToGo;
using test::AsciiMap;

namespace {

std::shared_ptr<const CostGrid> costsOf(const std::vector<std::string>& lines, int kernel = 1) {
  CostmapOptions options;
  options.kernel = kernel;
  options.unknown_weight = 1;
  CostmapBuilder builder(options);
  builder.setMap(std::make_shared<const grid::OccupancyGrid>(AsciiMap(lines).map));
  return builder.downsampled(StopToken());
}

std::vector<float> from(const std::vector<std::string>& lines, Cell goal, int kernel = 1) {
  return costsToGo(CostToGo(costsOf(lines, kernel), {goal}, 1, StopToken()));
}

TEST(CostToGoMessages, AreMetresTimesWeightRowByRow) {
  const std::vector<float> costs = from({"#.", ".."}, {0, 1});
  ASSERT_EQ(costs.size(), 4u);
  EXPECT_TRUE(std::isinf(costs[0]));
  EXPECT_FLOAT_EQ(costs[1], 2.0F);  // no corner is cut
  EXPECT_FLOAT_EQ(costs[2], 0.0F);
  EXPECT_FLOAT_EQ(costs[3], 1.0F);
}

TEST(CostToGoMessages, OfAKernelAreThoseOfTheFullMapsCells) {
  const std::vector<float> costs = from({"....", "....", "....", "...."}, {0, 0}, 2);
  ASSERT_EQ(costs.size(), 4u);
  EXPECT_FLOAT_EQ(costs[1], 2.0F);
  EXPECT_FLOAT_EQ(costs[3], static_cast<float>(2.0 * std::sqrt(2.0)));
}

TEST(CostToGoMessages, TheMapScalesThemToTheCostliest) {
  const std::vector<std::string> lines = {"...#.#",  //
                                          "##...#",  //
                                          ".....#",  //
                                          "####.#",  //
                                          "#....."};
  const auto message =
      costToGoMap(AsciiMap(lines).map.geometry(), from(lines, {4, 0}), "map", ros::Time(3));
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp, ros::Time(3));
  EXPECT_EQ(message.info.width, 6u);
  ASSERT_EQ(message.data.size(), 30u);
  EXPECT_EQ(message.data[4], 0);
  EXPECT_EQ(message.data[3], -1) << "occupied";
  EXPECT_EQ(message.data[10], 14) << "1 of 7";
  EXPECT_EQ(message.data[25], 100);
}

TEST(CostToGoMessages, WhereNothingIsReachedAllIsUnreached) {
  const AsciiMap map({"#."});
  const auto message = costToGoMap(map.map.geometry(), from({"#."}, {0, 0}), "map", ros::Time(3));
  EXPECT_EQ(message.data, std::vector<std::int8_t>({-1, -1}));
}

TEST(CostToGoMessages, TheImageHasTheSameValuesInTheSameOrder) {
  const AsciiMap map({"#.", ".."});
  const std::vector<float> costs = from({"#.", ".."}, {0, 1});
  const auto image = costToGoImage(map.map.geometry(), costs, "map", ros::Time(3));
  EXPECT_EQ(image.encoding, "32FC1");
  EXPECT_EQ(image.width, 2u);
  EXPECT_EQ(image.step, 8u);
  ASSERT_EQ(image.data.size(), 16u);
  std::vector<float> values(4);
  std::memcpy(values.data(), image.data.data(), 16);
  EXPECT_EQ(values, costs);
}

}  // namespace
}  // namespace grid_path_planner::nodes
