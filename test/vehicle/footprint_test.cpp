// The polygon itself: what is read, what is refused with which words, and its two radii.
#include "vehicle/footprint.h"

#include <gtest/gtest.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <random>

#include "support/error_text.h"

namespace grid_path_planner::vehicle {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point>;

Footprint footprintOf(const std::string& text) {
  return Footprint::fromText("footprint", text);
}

std::string refusalOf(const std::string& text) {
  return test::errorText([&] { footprintOf(text); });
}

TEST(Footprint, readsWhatUsersOfCostmap2dWrite) {
  const Footprint footprint = footprintOf(" [[0.5, 0.3],[0.5,-0.3], [-0.7, -0.3] ,[-0.7, 3e-1]] ");
  ASSERT_EQ(4u, footprint.corners().size());
  EXPECT_EQ(Eigen::Vector2d(-0.7, -0.3), footprint.corners()[2]);
  EXPECT_DOUBLE_EQ(0.3, footprint.inscribedRadius());
  EXPECT_DOUBLE_EQ(std::hypot(0.7, 0.3), footprint.circumscribedRadius());
}

TEST(Footprint, noneIsRound) {
  EXPECT_TRUE(footprintOf("").empty());
  EXPECT_TRUE(footprintOf("[]").empty());
  EXPECT_EQ(0.0, footprintOf("").inscribedRadius());
}

// The nearest point of the outline is a corner that is turned in.
TEST(Footprint, radiiOfAPolygonThatIsNotConvex) {
  const Footprint arrow = footprintOf("[[2, 0], [-1, 1], [-0.25, 0], [-1, -1]]");
  EXPECT_DOUBLE_EQ(0.25, arrow.inscribedRadius());
  EXPECT_DOUBLE_EQ(2.0, arrow.circumscribedRadius());
}

TEST(Footprint, whatIsNoListOfCornersIsRefusedWithThePlace) {
  EXPECT_EQ(
      "footprint must be corners in metres, [[x, y], [x, y], [x, y], ...], got "
      "'[[1, 2], [3 4]]', which is wrong from character 13 on",
      refusalOf("[[1, 2], [3 4]]"));
  for (const char* text :
       {"0.4", "[1, 2, 3]", "[[1, 1], [1, -1], [-1, 0]", "[[1, 1, 0], [2, 2, 0]]", "[[a, b]]",
        "[[1, 1], [1, -1], [-1, 0]] x", "{}", "[[", "[[1,"})
    EXPECT_NE(std::string::npos, refusalOf(text).find("which is wrong from character")) << text;
}

TEST(Footprint, whatIsNoOutlineIsRefused) {
  EXPECT_EQ("footprint needs 3 to 1000 corners, got 2", refusalOf("[[1, 1], [-1, -1]]"));
  EXPECT_EQ("footprint needs numbers up to 1000 m, got corner 2 [nan, 1]",
            refusalOf("[[1, 1], [nan, 1], [-1, 0]]"));
  EXPECT_EQ("footprint needs numbers up to 1000 m, got corner 1 [1001, 1]",
            refusalOf("[[1001, 1], [1, -1], [-1, 0]]"));
  EXPECT_EQ("footprint needs numbers up to 1000 m, got corner 1 [inf, 1]",
            refusalOf("[[inf, 1], [1, -1], [-1, 0]]"));
  EXPECT_EQ(
      "footprint crosses or touches itself: the edge from corner 1 [1, 1] meets that from "
      "corner 3 [1, -1]",
      refusalOf("[[1, 1], [-1, -1], [1, -1], [-1, 1]]"));
  EXPECT_NE("", refusalOf("[[1, 1], [1, -1], [-1, -1], [-1, 1], [1, 1]]")) << "closed twice";
  EXPECT_NE("", refusalOf("[[1, 1], [1, -1], [3, -1], [-1, -1], [-1, 1]]")) << "a spike";
  const std::string outside = "footprint must have the vehicle's origin [0, 0] inside";
  EXPECT_EQ(outside, refusalOf("[[1, 1], [2, 1], [2, 2]]"));
  EXPECT_EQ(outside, refusalOf("[[0, 1], [0, -1], [1, 0]]")) << "on an edge";
  EXPECT_EQ(outside, refusalOf("[[0, 0], [1, 1], [-1, 1]]")) << "at a corner";
}

TEST(Footprint, aHugeTextIsRefusedWithAShortOne) {
  std::string text = "[";
  for (int i = 0; i < 5000; ++i) text += "[1, 1],";
  const std::string refusal = refusalOf(text);
  EXPECT_NE(refusal.find("which is wrong from character"), std::string::npos) << refusal;
  EXPECT_LT(refusal.size(), 300u);
}

// Random polygons about the origin, star-shaped or not, against Boost.Geometry.
TEST(Footprint, radiiAndVerdictsAreThoseOfBoostGeometry) {
  const unsigned seed = 20261123;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  int taken = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<Eigen::Vector2d> corners(3 + random() % 4);
    Polygon polygon;
    for (Eigen::Vector2d& corner : corners) {
      corner = {coordinate(random), coordinate(random)};
      bg::append(polygon.outer(), Point(corner.x(), corner.y()));
    }
    bg::append(polygon.outer(), polygon.outer().front());
    bg::correct(polygon);
    const bool expected = bg::is_valid(polygon) && bg::within(Point(0, 0), polygon);
    try {
      const Footprint footprint("footprint", corners);
      ASSERT_TRUE(expected) << bg::wkt(polygon);
      bg::model::linestring<Point> outline(polygon.outer().begin(), polygon.outer().end());
      ASSERT_NEAR(bg::distance(Point(0, 0), outline), footprint.inscribedRadius(), 1e-12);
      double farthest = 0.0;
      for (const Point& corner : outline)
        farthest = std::max(farthest, bg::distance(Point(0, 0), corner));
      ASSERT_NEAR(farthest, footprint.circumscribedRadius(), 1e-12);
      ++taken;
    } catch (const base::InputError& error) {
      ASSERT_FALSE(expected) << error.what() << " " << bg::wkt(polygon);
    }
  }
  EXPECT_GT(taken, 200);
}

}  // namespace
}  // namespace grid_path_planner::vehicle
