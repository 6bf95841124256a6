#include "following/speed_limit.h"

#include <gtest/gtest.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <cmath>
#include <random>

#include "following/closed_loop.h"

namespace grid_path_planner::following {
namespace {

namespace bg = boost::geometry;
using Eigen::Vector3d;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using test::ClosedLoop;
using test::pathOf;
using Point = bg::model::d2::point_xy<double>;

// Half of max_speed from x = 6 to 8 m.
OccupancyGrid halfSpeed() {
  return OccupancyGrid(GridGeometry(10, 1, 1.0), {0, 0, 0, 0, 0, 0, 50, 50, 0, 0});
}

double allowedFrom(double x) {
  return allowedSpeed(halfSpeed(), {}, {{x, 0.5, 0.0}, {20.0, 0.5, 3.0}});
}

TEST(AllowedSpeed, FallsBeforeALimitAsTheVehicleCanBrake) {
  EXPECT_DOUBLE_EQ(allowedFrom(1.0), 0.8);
  EXPECT_NEAR(allowedFrom(5.9), std::sqrt(0.4 * 0.4 + 2.0 * 0.4 * 0.1), 1e-6);
  EXPECT_DOUBLE_EQ(allowedFrom(6.5), 0.4);
  EXPECT_DOUBLE_EQ(allowedFrom(8.1), 0.8);
  EXPECT_DOUBLE_EQ(allowedFrom(15.0), 0.8) << "outside the map";
  EXPECT_NEAR(speedLimitLookahead({}), 0.8, 1e-9) << "0.8 m/s at 0.4 m/s^2";
}

// A path along the line between two slow cells was driven at full speed: it meets the interior of neither.
TEST(AllowedSpeed, IsThatOfTheCellsWhoseEdgesThePathGoesAlongToo) {
  const OccupancyGrid limits(GridGeometry(2, 2, 1.0), {0, 25, 0, 25});
  EXPECT_NEAR(allowedSpeed(limits, {}, {{1.2, 1.0, 0.0}, {1.9, 1.0, 0.0}}), 0.2, 1e-6);
  EXPECT_NEAR(allowedSpeed(limits, {}, {{1.0, 0.2, 0.0}, {1.0, 1.9, 0.0}}), 0.2, 1e-6);
  EXPECT_DOUBLE_EQ(allowedSpeed(limits, {}, {{1.5, 1.5, 0.0}}), 0.2) << "a single point";
}

TEST(AllowedSpeed, NoLimitAreZeroAndUnknownAndAHundred) {
  const OccupancyGrid limits(GridGeometry(3, 1, 1.0), {0, -1, 100});
  EXPECT_DOUBLE_EQ(allowedSpeed(limits, {}, {{0.1, 0.5, 0.0}, {2.9, 0.5, 0.0}}), 0.8);
}

// By another hand: Boost.Geometry cuts the path at the squares of the cells.
TEST(AllowedSpeed, IsThatOfTheFirstPointInEachCell) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.0, 9.0);
  FollowerOptions options;
  options.max_speed = 3.0;
  for (int round = 0; round < 500; ++round) {
    OccupancyGrid limits(GridGeometry(8, 8, 1.0), 0);
    for (std::int8_t& value : limits.values())
      if (random() % 5 == 0) value = static_cast<std::int8_t>(1 + random() % 100);
    std::vector<Vector3d> ahead;
    for (int i = 0; i < 4; ++i) ahead.emplace_back(place(random), place(random), place(random));
    double expected = options.max_speed, driven = 0.0;
    for (std::size_t i = 0; i + 1 < ahead.size(); ++i) {
      const Point from(ahead[i].x(), ahead[i].y()), to(ahead[i + 1].x(), ahead[i + 1].y());
      bg::model::linestring<Point> line{from, to};
      for (int cell = 0; cell < 64; ++cell) {
        const int percent = limits.values()[static_cast<std::size_t>(cell)];
        const bg::model::box<Point> square(Point(cell % 8, cell / 8),
                                           Point(cell % 8 + 1, cell / 8 + 1));
        std::vector<bg::model::linestring<Point>> inside;
        bg::intersection(line, square, inside);
        if (percent < 1 || percent > 99 || inside.empty() || bg::length(inside[0]) < 1e-6) continue;
        const double limit = options.max_speed * percent / 100.0;
        const double distance = driven + bg::distance(from, inside[0]);
        expected = std::min(expected, std::sqrt(limit * limit + 0.8 * distance));
      }
      driven += bg::distance(from, to);
    }
    ASSERT_NEAR(allowedSpeed(limits, options, ahead), expected, 1e-6) << "round " << round;
  }
}

double planeSpeed(const base::BodyVelocity& v) {
  return std::hypot(v.surge, v.sway);
}

TEST(SpeedLimits, AreKeptInTheZoneAndNoLongerBehindIt) {
  ClosedLoop loop({}, {0.0, 0.5, 0.0});
  const OccupancyGrid limits = halfSpeed();
  loop.speed_limit = [&](const std::vector<Vector3d>& ahead) {
    return allowedSpeed(limits, loop.follower.options(), ahead);
  };
  loop.follower.start(pathOf({{0, 0.5}, {14, 0.5}}), Join::FIRST);
  double fastest_before = 0.0, fastest_inside = 0.0, fastest_behind = 0.0;
  loop.each_step = [&] {
    const double x = loop.pose().position.x();
    double& fastest = x < 5.0 ? fastest_before : x < 8.0 ? fastest_inside : fastest_behind;
    if (x < 5.0 || x > 6.05) fastest = std::max(fastest, planeSpeed(loop.command));
  };
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_GT(fastest_before, 0.75);
  EXPECT_LE(fastest_inside, 0.4 + 1e-9);
  EXPECT_GT(fastest_inside, 0.38) << "it does not stand";
  EXPECT_GT(fastest_behind, 0.75);
}

// What is steered to may be steeper than the path: the vehicle was 0.995 m/s fast at a limit of 0.8 where the share upwards
// was taken of the speed as it was wanted, and not as the plane's limit left it.
TEST(SpeedLimitsLaw, HoldInThePlaneAndUpwardsWhereverTheVehicleWasCarried) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> place(-3.0, 3.0), limit(0.05, 1.0);
  int at_plane_limit = 0, at_vertical_limit = 0;
  for (int trial = 0; trial < 100; ++trial) {
    FollowerOptions options;
    options.max_vertical_speed = limit(random);
    ClosedLoop loop(options);
    const double fastest = std::min(limit(random), options.max_speed);
    loop.speed_limit = [&](const std::vector<Vector3d>&) { return fastest; };
    loop.follower.start(pathOf({{-9, 0}, {9, 0}}), Join::NEAREST);
    loop.putAt({place(random), place(random), place(random)});
    loop.each_step = [&] {
      const double plane = planeSpeed(loop.command), vertical = std::abs(loop.command.heave);
      ASSERT_LE(plane, fastest + 1e-9) << "trial " << trial;
      ASSERT_LE(vertical, options.max_vertical_speed + 1e-9) << "trial " << trial;
      at_plane_limit += plane > fastest - 1e-6 ? 1 : 0;
      at_vertical_limit += vertical > options.max_vertical_speed - 1e-6 ? 1 : 0;
    };
    loop.run(5.0);
  }
  EXPECT_GT(at_plane_limit, 100);
  EXPECT_GT(at_vertical_limit, 100);
}

TEST(SpeedLimits, HoldForTheReturnToAPoseToo) {
  ClosedLoop loop;
  loop.follower.start(pathOf({{1, 0}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  loop.speed_limit = [](const std::vector<Vector3d>&) { return 0.1; };
  loop.putAt({4.0, 0.0, 0.0});
  double fastest = 0.0;
  loop.each_step = [&] { fastest = std::max(fastest, planeSpeed(loop.command)); };
  loop.run(5.0);
  EXPECT_LE(fastest, 0.1 + 1e-9);
  EXPECT_GT(fastest, 0.09);
}

}  // namespace
}  // namespace grid_path_planner::following
