#include "ros/planning/rectangle_markers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace grid_path_planner::nodes {

using grid::CellRect;
using grid::GridGeometry;

namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

MarkerArray markersOf(const GridGeometry& geometry, const std::vector<CellRect>& rectangles) {
  return rectangleMarkers(geometry, rectangles, "map", ros::Time(12));
}

TEST(RectangleMarkers, FillOutlineAndNumberEveryRectangle) {
  const MarkerArray array = markersOf(GridGeometry(10, 10, 0.5), {{0, 0, 4, 6}, {5, 0, 2, 2}});
  ASSERT_EQ(array.markers.size(), 5u);
  EXPECT_EQ(array.markers[0].action, Marker::DELETEALL);
  for (std::size_t i = 1; i < array.markers.size(); ++i) {
    EXPECT_EQ(array.markers[i].action, Marker::ADD);
    EXPECT_EQ(array.markers[i].header.frame_id, "map");
    EXPECT_EQ(array.markers[i].header.stamp, ros::Time(12));
  }
  EXPECT_EQ(array.markers[1].ns, "rectangles");
  EXPECT_EQ(array.markers[1].points.size(), 12u);
  EXPECT_EQ(array.markers[1].colors.size(), 12u);
  EXPECT_EQ(array.markers[2].ns, "outlines");
  EXPECT_EQ(array.markers[2].points.size(), 16u);
  EXPECT_EQ(array.markers[2].colors.size(), 16u);
  EXPECT_EQ(array.markers[3].text, "1");
  EXPECT_EQ(array.markers[4].text, "2");
  EXPECT_EQ(array.markers[4].ns, "numbers");
  EXPECT_NEAR(array.markers[4].pose.position.x, 3.0, 1e-9);
  EXPECT_NEAR(array.markers[4].pose.position.y, 0.5, 1e-9);
}

TEST(RectangleMarkers, CoverTheRectanglesOfATurnedMap) {
  const GridGeometry geometry(10, 10, 0.5, {3.0, -2.0, 0.7});
  const CellRect rect{2, 3, 4, 1};
  const MarkerArray array = markersOf(geometry, {rect});
  double area = 0.0;
  const auto& points = array.markers[1].points;
  for (std::size_t i = 0; i < points.size(); i += 3) {
    for (std::size_t k = i; k < i + 3; ++k) {
      const auto cell = geometry.cellAt({points[k].x, points[k].y});
      ASSERT_TRUE(cell);
      EXPECT_TRUE(rect.contains(*cell));
    }
    area += 0.5 * std::abs((points[i + 1].x - points[i].x) * (points[i + 2].y - points[i].y) -
                           (points[i + 2].x - points[i].x) * (points[i + 1].y - points[i].y));
  }
  EXPECT_LE(area, 4 * 0.25);
  EXPECT_GT(area, 0.8 * 4 * 0.25);
}

TEST(RectangleMarkers, NeighbouringNumbersDifferInColour) {
  std::vector<CellRect> rectangles;
  for (int i = 0; i < 30; ++i) rectangles.push_back({i, 0, 1, 1});
  const MarkerArray array = markersOf(GridGeometry(30, 1, 1.0), rectangles);
  std::set<std::tuple<float, float, float>> colours;
  for (const auto& colour : array.markers[1].colors) {
    colours.insert({colour.r, colour.g, colour.b});
    for (const float channel : {colour.r, colour.g, colour.b, colour.a}) {
      EXPECT_GT(channel, 0.0F);
      EXPECT_LE(channel, 1.0F);
    }
  }
  EXPECT_EQ(colours.size(), 30u);
}

TEST(RectangleMarkers, OnlyTheLargestAreNumberedAndShown) {
  const int side = 300;
  std::vector<CellRect> rectangles;
  for (int i = 0; i < side * side; ++i) rectangles.push_back({i % side, i / side, 1, 1});
  const MarkerArray array = markersOf(GridGeometry(side, side, 1.0), rectangles);
  EXPECT_EQ(array.markers.size(), 3 + kMostNumberedRectangles);
  EXPECT_EQ(array.markers[1].points.size(), 6 * kMostShownRectangles);
}

TEST(RectangleMarkers, OfNothingDeleteWhatWasThere) {
  for (const std::vector<CellRect>& none : {std::vector<CellRect>{}, std::vector<CellRect>{{}}}) {
    const MarkerArray array = markersOf(GridGeometry(3, 3, 1.0), none);
    ASSERT_EQ(array.markers.size(), 1u);
    EXPECT_EQ(array.markers[0].action, Marker::DELETEALL);
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
