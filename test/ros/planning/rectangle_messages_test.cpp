#include "ros/planning/rectangle_messages.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "grid_path_planner/planners/decomposition.h"
#include "support/error_text.h"
#include "support/free_cells.h"

namespace grid_path_planner::nodes {

using base::StopToken;
using grid::GridGeometry;
using planners::largestFirst;
using planners::RectangleGraph;
using planners::Touching;

namespace {

using test::errorText;

RectangleMap goodRectangles() {
  return rectanglesToMessage(GridGeometry(10, 6, 0.05, {-1.5, 2.0, 0.0}),
                             {{0, 0, 4, 3}, {4, 0, 2, 1}, {9, 5, 1, 1}}, "map", ros::Time(12, 34));
}

// What is said of a good message after `spoil`.
std::string errorOfRectangles(const std::function<void(RectangleMap&)>& spoil) {
  RectangleMap message = goodRectangles();
  spoil(message);
  return errorText([&message] { rectanglesFromMessage(message, Touching::BORDERS); });
}

TEST(RectangleMessages, SayWhereAndWhat) {
  const RectangleMap message = goodRectangles();
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp, ros::Time(12, 34));
  EXPECT_EQ(message.info.width, 10u);
  EXPECT_EQ(message.info.height, 6u);
  EXPECT_EQ(message.info.resolution, 0.05F);
  EXPECT_EQ(message.info.origin.position.x, -1.5);
  ASSERT_EQ(message.rectangles.size(), 3u);
  EXPECT_EQ(message.rectangles[1].column, 4u);
  EXPECT_EQ(message.rectangles[1].row, 0u);
  EXPECT_EQ(message.rectangles[1].width, 2u);
  EXPECT_EQ(message.rectangles[1].height, 1u);
}

TEST(RectangleMessages, ComeBackTheSame) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const test::FreeCells free = test::randomBlocks(random, 50);
    const GridGeometry geometry(free.width(), free.height(), 0.05, {-3.25, 1.5, 0.25});
    const RectangleGraph map(geometry, largestFirst(test::bitMapsOf(free), {}, StopToken()),
                             Touching::BORDERS_AND_CORNERS);
    const RectangleGraph same =
        rectanglesFromMessage(rectanglesToMessage(geometry, map.rectangles(), "map", ros::Time(1)),
                              Touching::BORDERS_AND_CORNERS);
    ASSERT_EQ(same.rectangles(), map.rectangles());
    ASSERT_EQ(same.connections().size(), map.connections().size());
    EXPECT_EQ(same.geometry().rect(), geometry.rect());
    EXPECT_EQ(same.geometry().resolution(), 0.05);
    EXPECT_EQ(same.geometry().origin().x, -3.25);
    EXPECT_NEAR(same.geometry().origin().yaw, 0.25, 1e-12);
  }
}

TEST(RectangleMessages, LeaveOutVacantNumbers) {
  const RectangleMap message = rectanglesToMessage(
      GridGeometry(4, 4, 1.0), {{0, 0, 2, 2}, {}, {3, 3, 1, 1}}, "map", ros::Time(1));
  ASSERT_EQ(message.rectangles.size(), 2u);
  EXPECT_EQ(message.rectangles[1].column, 3u);
}

TEST(RectangleMessages, BadOnesAreRefusedByName) {
  EXPECT_EQ(errorOfRectangles([](RectangleMap&) {}), "");
  EXPECT_EQ(errorOfRectangles([](auto& message) { message.rectangles[1].width = 0; }),
            "rectangle 1 [4, 0, 0, 1] holds no cell");
  EXPECT_EQ(errorOfRectangles([](auto& message) { message.rectangles[2].height = 2; }),
            "rectangle 2 [9, 5, 1, 2] leaves the map of 10x6 cells");
  EXPECT_EQ(errorOfRectangles([](auto& message) { message.rectangles[1].column = 3; }),
            "rectangle 0 [0, 0, 4, 3] overlaps rectangle 1 [3, 0, 2, 1]");
  EXPECT_EQ(errorOfRectangles([](auto& message) { message.rectangles[1].row = 0xffffffffu; }),
            "rectangle 1 has a number beyond any map, 4294967295");
  EXPECT_EQ(errorOfRectangles([](auto& message) { message.rectangles[1].column = 0x7fffffffu; }),
            "rectangle 1 [2147483647, 0, 2, 1] leaves the map of 10x6 cells");
  EXPECT_NE(errorOfRectangles([](auto& message) { message.info.width = 0; }), "");
  EXPECT_NE(errorOfRectangles([](auto& message) { message.info.resolution = 0; }), "");
}

}  // namespace
}  // namespace grid_path_planner::nodes
