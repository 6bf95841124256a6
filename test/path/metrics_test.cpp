#include "grid_path_planner/path/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <random>

#include "path/clearance_meter.h"
#include "support/ascii_map.h"
#include "support/kept_distance.h"
#include "support/path_through.h"
#include "support/random_map.h"

namespace grid_path_planner::path {

using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using grid::OccupancyThresholds;

namespace {

using test::AsciiMap;
using test::pathThrough;

TEST(Metrics, Square) {
  const Path square = pathThrough({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}});
  EXPECT_DOUBLE_EQ(lengthOf(square), 12.0);
  EXPECT_DOUBLE_EQ(turningOf(square), 3 * M_PI / 2);
}

TEST(Metrics, StairsTurnEveryTime) {
  const Path stairs = pathThrough({{0, 0}, {1, 0}, {2, 1}, {3, 1}});
  EXPECT_DOUBLE_EQ(lengthOf(stairs), 2 + std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(turningOf(stairs), M_PI / 2);
}

TEST(Metrics, CoincidingPosesAddNothing) {
  const Path path = pathThrough({{0, 0}, {0, 0}, {-1, 0}, {-1, 0}, {-1, 0}, {-1, -2}, {-1, -2}});
  EXPECT_DOUBLE_EQ(lengthOf(path), 3.0);
  EXPECT_DOUBLE_EQ(turningOf(path), M_PI / 2);
}

TEST(Metrics, TurningBackIsHalfATurn) {
  EXPECT_DOUBLE_EQ(turningOf(pathThrough({{0, 0}, {5, 0}, {2, 0}})), M_PI);
}

TEST(Metrics, StraightPathsTurnNowhereInAnyDirection) {
  for (const int x : {-1, 0, 1})
    for (const int y : {-1, 0, 1})
      EXPECT_EQ(turningOf(pathThrough({{0, 0}, {1.0 * x, 1.0 * y}, {2.0 * x, 2.0 * y}})), 0.0)
          << x << ' ' << y;
}

TEST(Metrics, PathsThatGoNowhere) {
  for (const Path& path : {Path(), pathThrough({{1, 2}}), pathThrough({{1, 2}, {1, 2}})}) {
    EXPECT_EQ(lengthOf(path), 0.0);
    EXPECT_EQ(turningOf(path), 0.0);
  }
}

TEST(Metrics, HeightCountsNothing) {
  Path path = pathThrough({{0, 0}, {3, 4}});
  path.poses[1].position.z() = 100.0;
  EXPECT_DOUBLE_EQ(lengthOf(path), 5.0);
}

TEST(Metrics, CircleTurnsOnceRound) {
  Path circle;
  for (int i = 0; i <= 360; ++i) {
    circle.poses.emplace_back();
    circle.poses.back().position << 2.0 * std::cos(i * M_PI / 180), 2.0 * std::sin(i * M_PI / 180),
        0;
  }
  EXPECT_NEAR(lengthOf(circle), 4 * M_PI, 1e-3);
  EXPECT_NEAR(turningOf(circle), 2 * M_PI * 359 / 360, 1e-9);
}

TEST(Clearance, BesideAnObstacle) {
  const AsciiMap picture({".....",  //
                          "..#..",  //
                          "....."},
                         0.5);
  const OccupancyThresholds thresholds;
  // Along the middle of row 0: half a cell to the edge of the obstacle.
  EXPECT_DOUBLE_EQ(clearanceOf(pathThrough({{0.25, 0.25}, {2.25, 0.25}}), picture.map, thresholds),
                   0.25);
  // A single pose, nearest to the obstacle's corner.
  EXPECT_DOUBLE_EQ(clearanceOf(pathThrough({{0.7, 0.1}}), picture.map, thresholds), 0.5);
}

TEST(Clearance, IsZeroThroughAnObstacleAndAlongItsEdge) {
  const AsciiMap picture({".....",  //
                          "..#..",  //
                          "....."});
  const OccupancyThresholds thresholds;
  EXPECT_EQ(clearanceOf(pathThrough({{0.5, 1.4}, {4.5, 1.6}}), picture.map, thresholds), 0.0);
  EXPECT_EQ(clearanceOf(pathThrough({{2.5, 1.5}}), picture.map, thresholds), 0.0);
  EXPECT_EQ(clearanceOf(pathThrough({{0.5, 1.0}, {4.5, 1.0}}), picture.map, thresholds), 0.0);
}

TEST(Clearance, SeesAnObstacleBetweenAnySamples) {
  // The path passes a corner at a distance of 0.001 between two poses that are far apart.
  const AsciiMap picture({"....................",  //
                          ".........##########."});
  const Path path = pathThrough({{0.5, 0.999}, {19.5, 0.999}});
  EXPECT_NEAR(clearanceOf(path, picture.map, {}), 0.001, 1e-12);
}

TEST(Clearance, IsInfiniteWhereNothingIsOccupied) {
  const AsciiMap picture({"..?", "???"});
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(clearanceOf(pathThrough({{0.5, 0.5}}), picture.map, {}), infinity);
  EXPECT_EQ(clearanceOf(Path(), AsciiMap({"#"}).map, {}), infinity);
  EXPECT_EQ(clearanceOf(pathThrough({{0.5, 0.5}}), OccupancyGrid(), {}), infinity);
}

TEST(Clearance, FollowsTheThresholds) {
  OccupancyGrid map(GridGeometry(3, 1, 1.0), {0, 0, 40});
  const Path path = pathThrough({{0.5, 0.5}});
  EXPECT_EQ(clearanceOf(path, map, {25, 40}), 1.5);
  EXPECT_EQ(clearanceOf(path, map, {25, 41}), std::numeric_limits<double>::infinity());
}

TEST(Clearance, FollowsTheMapsPose) {
  const AsciiMap picture({"..#"}, 1.0, {10.0, 20.0, M_PI / 2});  // the row runs north from (10, 20)
  EXPECT_NEAR(clearanceOf(pathThrough({{9.5, 20.5}}), picture.map, {}), 1.5, 1e-12);
}

TEST(Clearance, OutsideTheMapIsNotOccupied) {
  const AsciiMap picture({"#.."});
  EXPECT_DOUBLE_EQ(clearanceOf(pathThrough({{100.0, 0.5}}), picture.map, {}), 99.0);
}

// The least distance from points of the path, taken every `step`, to every occupied cell.
double sampledClearance(const Path& path, const OccupancyGrid& map, double step) {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Eigen::Vector2d& point) {
    const Eigen::Vector2d p = map.geometry().gridFromWorld(point);
    for (int row = 0; row < map.height(); ++row)
      for (int column = 0; column < map.width(); ++column) {
        if (map[Cell{column, row}] < 65) continue;
        const double dx = std::max({column - p.x(), 0.0, p.x() - column - 1});
        const double dy = std::max({row - p.y(), 0.0, p.y() - row - 1});
        least = std::min(least, std::hypot(dx, dy) * map.geometry().resolution());
      }
  };
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const Eigen::Vector2d from = path.poses[i == 0 ? 0 : i - 1].position.head<2>();
    const Eigen::Vector2d to = path.poses[i].position.head<2>();
    const int pieces = 1 + static_cast<int>((to - from).norm() / step);
    for (int k = 0; k <= pieces; ++k) look(from + (to - from) * k / pieces);
  }
  return least;
}

// Long paths of short steps, where most segments are spared by what is known around those before, and
// short paths of long ones; from maps full of obstacles to such with none.
TEST(ClearanceLaw, WanderingPathsHaveThatOfAnIndependentJudge) {
  std::mt19937 random(1419);
  for (int trial = 0; trial < 80; ++trial) {
    const double occupied =
        std::pow(10.0, -std::uniform_real_distribution<double>(1.5, 4.5)(random));
    const OccupancyGrid map = test::randomOccupancy(random, 150, occupied, 0.2);
    const double step = trial % 2 == 0 ? 1.0 : 20.0;
    std::uniform_real_distribution<double> place(-5.0, 155.0);
    std::normal_distribution<double> move(0.0, step);
    std::vector<Eigen::Vector2d> points = {{place(random), place(random)}};
    while (points.size() < 1 + 200.0 / step)
      points.push_back(points.back() + Eigen::Vector2d(move(random), move(random)));
    const double none = 1e6;
    const double judged = test::leastDistance(points, map, {}, none);
    const double clearance = clearanceOf(pathThrough(points), map, {});
    EXPECT_NEAR(std::min(clearance, none), judged, 1e-9) << "trial " << trial;
  }
}

// Another path has been measured before, whose squares of the map are known already.
TEST(ClearanceLaw, OneMeterForManyPathsSaysTheSame) {
  std::mt19937 random(2811);
  for (int trial = 0; trial < 30; ++trial) {
    const double occupied = std::pow(10.0, -std::uniform_real_distribution<double>(2, 4.5)(random));
    const auto map = std::make_shared<OccupancyGrid>(
        test::randomOccupancy(random, 60 + 9 * trial, occupied, 0.2));
    std::uniform_real_distribution<double> place(-20.0, map->width() + 20.0);
    ClearanceMeter meter(map, {});
    for (int i = 0; i < 10; ++i) {
      std::vector<Eigen::Vector2d> points;
      for (int k = 0; k <= i % 4; ++k) points.emplace_back(place(random), place(random));
      const double none = 1e6;
      const double judged = test::leastDistance(points, *map, {}, none);
      EXPECT_NEAR(std::min(meter.clearanceOf(pathThrough(points)), none), judged, 1e-9)
          << "trial " << trial << ", path " << i;
    }
  }
}

TEST(ClearanceLaw, IsTheLeastOverAllPointsAndCells) {
  std::mt19937 random(703);
  for (int trial = 0; trial < 100; ++trial) {
    std::uniform_int_distribution<int> side(1, 20);
    std::uniform_real_distribution<double> place(-3.0, 3.0);
    const double resolution = std::uniform_real_distribution<double>(0.1, 0.5)(random);
    OccupancyGrid map(GridGeometry(side(random), side(random), resolution,
                                   {place(random), place(random), place(random)}));
    std::bernoulli_distribution occupied(trial % 2 ? 0.02 : 0.1);
    for (std::int8_t& value : map.values()) value = occupied(random) ? 100 : 0;
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i <= trial % 4; ++i) points.emplace_back(place(random), place(random));
    const Path path = pathThrough(points);
    const double step = 0.05 * resolution;
    const double sampled = sampledClearance(path, map, step);
    const double clearance = clearanceOf(path, map, {});
    if (std::isinf(sampled)) {
      EXPECT_EQ(clearance, sampled) << "trial " << trial;
    } else {
      EXPECT_LE(clearance, sampled + 1e-9) << "trial " << trial;
      EXPECT_GE(clearance, sampled - step) << "trial " << trial;
    }
  }
}

// The processor's seconds for the clearance of many poses at one end of a map whose one obstacle is at the other.
double secondsAlong(bool tall) {
  constexpr int kLong = 1 << 19;
  const auto map =
      std::make_shared<OccupancyGrid>(GridGeometry(tall ? 1 : kLong, tall ? kLong : 1, 1.0));
  map->values().back() = 100;
  ClearanceMeter meter(map, {});
  const auto look = [&](int place) {
    const Eigen::Vector2d pose = map->geometry().centre(tall ? Cell{0, place} : Cell{place, 0});
    EXPECT_EQ(meter.clearanceOf(pathThrough({pose})), kLong - 1.5 - place);
  };
  look(0);  // the first looks at the whole map
  const std::clock_t begin = std::clock();
  for (int place = 0; place < 50; ++place) look(place);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// What was seen before: each ring of squares around the pose visited every row of the map that it reached, although its
// columns lay outside.
TEST(ClearanceLaw, TallMapsTakeNoLongerThanWideOnes) {
  EXPECT_LT(secondsAlong(true), 0.1 + 20.0 * secondsAlong(false));
}

TEST(ClearanceLaw, LargeMapsAreNoTrouble) {
  OccupancyGrid map(GridGeometry(1000, 1000, 0.05));
  map[Cell{999, 0}] = 100;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 1000; ++i) points.push_back(map.geometry().centre({i / 2, i}));
  const double expected = (Eigen::Vector2d(999, 1) - Eigen::Vector2d(200.3, 400.1)).norm();
  EXPECT_NEAR(clearanceOf(pathThrough(points), map, {}) / 0.05, expected, 1.0);
}

}  // namespace
}  // namespace grid_path_planner::path
