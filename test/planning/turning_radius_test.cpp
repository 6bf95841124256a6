// Paths for a vehicle that cannot turn on the spot: pictures, and the law of the radius on random maps.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_path_planner/planning/path_planner.h"
#include "planning/via/via_plan.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/footprint_reference.h"
#include "support/kept_distance.h"

namespace grid_path_planner::planning {

using base::Status;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using path::HeadingMode;
using path::Path;
using test::AsciiMap;
using test::contains;
using test::errorText;

namespace {

// The smallest radius of a circle through three poses one after another, and how far the first and the last line turn from the
// headings at the ends, in radians.
struct Turning {
  double radius = 1e9;
  double at_ends = 0.0;
};

Turning turningOfPath(const Path& path, double start_direction, double goal_direction) {
  Turning turning;
  const auto at = [&](std::size_t i) -> Eigen::Vector2d {
    return path.poses[i].position.head<2>();
  };
  const auto angle = [&](std::size_t i) {
    const Eigen::Vector2d along = at(i + 1) - at(i);
    return std::atan2(along.y(), along.x());
  };
  const std::size_t last = path.poses.size() - 1;
  for (std::size_t i = 1; i < last; ++i) {
    const double a = (at(i) - at(i - 1)).norm(), b = (at(i + 1) - at(i)).norm();
    const double turn = std::abs(std::remainder(angle(i) - angle(i - 1), 2.0 * M_PI));
    if (turn > 1e-6) turning.radius = std::min(turning.radius, std::max(a, b) / turn);
  }
  turning.at_ends =
      std::max(std::abs(std::remainder(angle(0) - start_direction, 2.0 * M_PI)),
               std::abs(std::remainder(angle(last - 1) - goal_direction, 2.0 * M_PI)));
  return turning;
}

struct TurningQuestion {
  OccupancyGrid map;
  PoseRequest request;
  PlannerOptions options = {};

  explicit TurningQuestion(const AsciiMap& picture) : map(picture.map) {
    request.start.position << map.geometry().centre(picture.start), 0.0;
    request.goal.position << map.geometry().centre(picture.goal), 0.0;
    options.costmap.radius = 0.2;
    options.min_turning_radius = 1.0;
  }
  Plan plan() const {
    PathPlanner planner(options);
    planner.setMap(std::make_shared<const OccupancyGrid>(map));
    return planner.plan(request);
  }
};

AsciiMap roomWithAWall() {
  std::vector<std::string> lines(40, std::string(50, '.'));
  for (int row = 0; row < 25; ++row) lines[row][25] = '#';
  lines[8][8] = 'S';
  lines[8][42] = 'G';
  return AsciiMap(lines, 0.2);
}

TEST(TurningRadius, cornersBecomeCurvesFromHeadingToHeading) {
  TurningQuestion question(roomWithAWall());
  for (const double yaw : {0.0, 2.0, -2.0}) {
    question.request.start.yaw = yaw;
    question.request.goal.yaw = -yaw;
    const Plan plan = question.plan();
    ASSERT_EQ(Status::FOUND, plan.status) << plan.message;
    EXPECT_EQ(0u, plan.sharp_corners);
    EXPECT_TRUE(contains(plan.message, "its turns have a radius of 1 m at least")) << plan.message;
    const Turning turning = turningOfPath(plan.path, yaw, -yaw);
    EXPECT_GE(turning.radius, 0.99);
    EXPECT_LE(turning.at_ends, 0.06);
    EXPECT_EQ(plan.path.poses.back().yaw, -yaw);
    EXPECT_FALSE(plan.optimal);
    EXPECT_EQ(plan.waypoints.poses.size(), plan.path.poses.size());
  }
}

TEST(TurningRadius, zeroTurnsOnTheSpot) {
  TurningQuestion question(roomWithAWall());
  question.options.min_turning_radius = 0.0;
  const Plan plan = question.plan();
  EXPECT_LT(plan.path.poses.size(), 8u);
  EXPECT_EQ(0u, plan.sharp_corners);
}

AsciiMap narrowCorner() {
  std::vector<std::string> lines(20, std::string(20, '#'));
  for (int i = 1; i < 19; ++i)
    for (int j = 1; j < 5; ++j) lines[j][i] = lines[i][14 + j] = '.';
  lines[2][2] = 'S';
  lines[17][16] = 'G';
  return AsciiMap(lines, 0.2);
}

// 0.8 m wide: a radius of 1 m fits at a corner that is cut inside, one of 3 m does not.
TEST(TurningRadius, whereNoCurveFitsItSaysSoAndTheParameterDecides) {
  TurningQuestion question(narrowCorner());
  question.request.goal.yaw = M_PI / 2;
  question.options.min_turning_radius = 3.0;
  const Plan none = question.plan();
  EXPECT_EQ(Status::UNREACHABLE, none.status);
  EXPECT_TRUE(contains(none.message, "sharp, since no curve of 3 m fits, the first at ("))
      << none.message;
  EXPECT_TRUE(none.path.empty());
  question.options.keep_sharp_corners = true;
  const Plan sharp = question.plan();
  ASSERT_EQ(Status::FOUND, sharp.status);
  EXPECT_GE(sharp.sharp_corners, 1u);
  question.options.min_turning_radius = 0.5;
  const Plan curved = question.plan();
  ASSERT_EQ(Status::FOUND, curved.status) << curved.message;
  EXPECT_EQ(0u, curved.sharp_corners) << curved.message;
}

// "The first at (-10, 0.5)" was the goal, whose heading, 0 by default, nobody had asked for.
TEST(TurningRadius, aCornerAtAnEndIsToldAsTheHeadingThere) {
  TurningQuestion question(AsciiMap({"##########", "#S......G#", "##########"}, 1.0));
  EXPECT_EQ(Status::FOUND, question.plan().status);
  question.request.goal.yaw = M_PI / 2;
  const Plan goal = question.plan();
  EXPECT_EQ(Status::UNREACHABLE, goal.status);
  EXPECT_TRUE(
      contains(goal.message, "the first at the goal (8.5, 1.5), which asks for heading 90 deg"))
      << goal.message;
  question.request.goal.yaw = 0.0;
  question.request.start.yaw = M_PI;
  const Plan start = question.plan();
  EXPECT_EQ(Status::UNREACHABLE, start.status);
  EXPECT_TRUE(contains(start.message, "the first at the start (1.5, 1.5), with heading 180 deg"))
      << start.message;
}

TEST(TurningRadius, turningOnTheSpotIsNoPath) {
  TurningQuestion question(roomWithAWall());
  question.request.goal = question.request.start;
  EXPECT_EQ(Status::FOUND, question.plan().status);
  question.request.goal.yaw = 1.0;
  EXPECT_EQ(Status::UNREACHABLE, question.plan().status);
}

TEST(TurningRadius, headingsThatTurnWhileDrivingAreRefused) {
  PlannerOptions options;
  options.min_turning_radius = 1.0;
  options.heading = HeadingMode::INTERPOLATE;
  EXPECT_EQ("min_turning_radius needs heading forward, backward or none, got heading interpolate",
            errorText([&] { checkPlannerOptions(options); }));
}

TEST(TurningRadius, viaPointsArePassedWithoutACorner) {
  const TurningQuestion question(roomWithAWall());
  PathPlanner planner(question.options);
  planner.setMap(std::make_shared<const OccupancyGrid>(question.map));
  ViaRequest request;
  request.start = question.request.start;
  request.goal = question.request.goal;
  request.via = {{2.0, 6.0, 0.0}, {7.0, 7.0, 0.0}};
  const Plan plan = planThrough(planner, request).plan;
  ASSERT_EQ(Status::FOUND, plan.status) << plan.message;
  EXPECT_GE(turningOfPath(plan.path, 0.0, 0.0).radius, 0.99);
}

// On noise and blocks: radius, headings at the ends, the distance to obstacles, and the footprint, backwards too.
TEST(TurningRadius, lawsOnRandomMaps) {
  const unsigned seed = 17132;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.5, 9.5), yaw(-M_PI, M_PI);
  const std::vector<Eigen::Vector2d> vehicle = {{0.5, 0.2}, {-0.3, 0.2}, {-0.3, -0.2}, {0.5, -0.2}};
  int curved = 0, none = 0;
  for (int i = 0; i < 60; ++i) {
    OccupancyGrid map(GridGeometry(100, 100, 0.1));
    for (unsigned blocks = random() % 25; blocks > 0; --blocks) {
      const Cell low{static_cast<int>(random() % 96), static_cast<int>(random() % 96)};
      for (int row = low.row; row < low.row + 4; ++row)
        for (int column = low.column; column < low.column + 4; ++column)
          map[Cell{column, row}] = 100;
    }
    PlannerOptions options;
    options.min_turning_radius = 0.3 + 0.1 * (random() % 12);
    options.costmap.radius = 0.25;
    options.smooth = random() % 3 != 0;
    options.heading = random() % 3 == 0 ? HeadingMode::BACKWARD : HeadingMode::FORWARD;
    const bool polygon = random() % 2 == 0;
    if (polygon) options.footprint = "[[0.5, 0.2], [-0.3, 0.2], [-0.3, -0.2], [0.5, -0.2]]";
    PathPlanner planner(options);
    planner.setMap(std::make_shared<const OccupancyGrid>(map));
    PoseRequest request;
    request.start.position << place(random), place(random), 0.0;
    request.goal.position << place(random), place(random), 0.0;
    request.start.yaw = yaw(random);
    request.goal.yaw = yaw(random);
    const Plan plan = planner.plan(request);
    none += plan.status == Status::UNREACHABLE;
    if (!plan.found() || plan.path.poses.size() < 2) continue;
    ++curved;
    const double back = options.heading == HeadingMode::BACKWARD ? M_PI : 0.0;
    const Turning turning =
        turningOfPath(plan.path, request.start.yaw + back, request.goal.yaw + back);
    ASSERT_GE(turning.radius, 0.99 * options.min_turning_radius) << i << plan.message;
    ASSERT_LE(turning.at_ends, 0.06) << i;
    std::vector<Eigen::Vector2d> points;
    for (const path::Pose& pose : plan.path.poses) points.push_back(pose.position.head<2>());
    ASSERT_GE(test::leastDistance(points, map, {true, false, false}, 0.25), 0.25 - 1e-6) << i;
    if (polygon) {
      ASSERT_LT(
          test::largestOverlap(vehicle, plan.path, request.start.yaw, options.heading, 0.05, map),
          1e-5)
          << i;
    }
  }
  std::printf("curved %d, none %d\n", curved, none);
  EXPECT_GT(curved, 20);
}

}  // namespace
}  // namespace grid_path_planner::planning
