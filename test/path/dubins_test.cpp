// Dubins' curves: known ones, and laws on random ends.
#include "path/dubins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace grid_path_planner::path {
namespace {

using Eigen::Vector2d;

TEST(Dubins, straightOnAndTurningBack) {
  EXPECT_NEAR(5.0, dubinsCurve({{0, 0}, 0}, {{5, 0}, 0}, 1.0).length(), 1e-9);
  EXPECT_NEAR(M_PI, dubinsCurve({{0, 0}, 0}, {{0, 2}, M_PI}, 1.0).length(), 1e-9);
  EXPECT_NEAR(2.0 * M_SQRT2 + M_PI / 2, dubinsCurve({{0, 0}, 0}, {{3, 3}, M_PI / 2}, 1.0).length(),
              1e-9);
  // On the spot: three arcs, of 60, 300 and 60 degrees.
  EXPECT_NEAR(7.0 * M_PI / 3.0, dubinsCurve({{0, 0}, 0}, {{0, 0}, M_PI}, 1.0).length(), 1e-9);
  EXPECT_NEAR(0.0, dubinsCurve({{1, 2}, 3}, {{1, 2}, 3}, 1.0).length(), 1e-6);
}

TEST(Dubins, pointsLieOnTheCurveAndEndWhereItEnds) {
  const DubinsCurve curve = dubinsCurve({{0, 0}, 0}, {{3, 3}, M_PI / 2}, 1.0);
  const std::vector<Vector2d> points = curve.points(0.1);
  ASSERT_EQ(17u, points.size()) << "two arcs of 45 degrees, 8 points each, and a line";
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(1.0, (points[i] - Vector2d(0, 1)).norm(), 1e-9);
  for (std::size_t i = 8; i < 17; ++i) EXPECT_NEAR(1.0, (points[i] - Vector2d(2, 3)).norm(), 1e-9);
  EXPECT_NEAR(0.0, (points.back() - Vector2d(3, 3)).norm(), 1e-9);
}

// The end is met; driven back, it is as long; a larger radius makes no shorter curve of ends far apart; and none is
// shorter than the line.
TEST(Dubins, lawsOnRandomEnds) {
  const unsigned seed = 1957;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-5.0, 5.0), angle(-7.0, 7.0), size(0.1, 3.0);
  for (int i = 0; i < 20000; ++i) {
    const DirectedPoint a{{place(random), place(random)}, angle(random)};
    const DirectedPoint b{{place(random), place(random)}, angle(random)};
    const double radius = size(random);
    const DubinsCurve curve = dubinsCurve(a, b, radius);
    ASSERT_NEAR(0.0, (curve.end().position - b.position).norm(), 1e-6);
    ASSERT_NEAR(0.0, std::remainder(curve.end().direction - b.direction, 2.0 * M_PI), 1e-6);
    const DubinsCurve back =
        dubinsCurve({b.position, b.direction + M_PI}, {a.position, a.direction + M_PI}, radius);
    ASSERT_NEAR(curve.length(), back.length(), 1e-6);
    const double straight = (a.position - b.position).norm();
    ASSERT_GE(curve.length(), straight - 1e-9);
    if (straight > 8.0 * radius) {
      ASSERT_LE(curve.length(), dubinsCurve(a, b, 1.2 * radius).length() + 1e-9);
      ASSERT_LE(curve.length(), straight + 2.0 * M_PI * radius * 1.5 + 4.0 * radius);
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::path
