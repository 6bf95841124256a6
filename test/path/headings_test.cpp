#include "grid_path_planner/path/headings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace grid_path_planner::path {
namespace {

Path pathOfWrongYaws(const std::vector<Eigen::Vector2d>& points) {
  Path path;
  for (const Eigen::Vector2d& point : points) {
    Pose pose;
    pose.position << point, 0.0;
    pose.yaw = 0.123;  // not what any mode gives
    path.poses.push_back(pose);
  }
  return path;
}

std::vector<double> yawsOf(const Path& path) {
  std::vector<double> yaws;
  for (const Pose& pose : path.poses) yaws.push_back(pose.yaw);
  return yaws;
}

std::vector<double> headings(const std::vector<Eigen::Vector2d>& points, double start_yaw,
                             double goal_yaw, HeadingMode mode) {
  Path path = pathOfWrongYaws(points);
  applyHeadings(path, start_yaw, goal_yaw, mode);
  return yawsOf(path);
}

double angleBetween(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * M_PI));
}

void expectYaws(const std::vector<double>& yaws, const std::vector<double>& expected) {
  ASSERT_EQ(yaws.size(), expected.size());
  for (std::size_t i = 0; i < yaws.size(); ++i)
    EXPECT_NEAR(angleBetween(yaws[i], expected[i]), 0.0, 1e-9) << "pose " << i << ": " << yaws[i];
}

// East, then north, then west:  3 <- 2
//                                    ^
//                               0 -> 1
const std::vector<Eigen::Vector2d> kHook = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
constexpr double kEast = 0.0, kNorth = M_PI / 2, kWest = M_PI, kSouth = -M_PI / 2;

TEST(Headings, Hook) {
  const double goal = 0.7;
  expectYaws(headings(kHook, 0.3, goal, HeadingMode::NONE), {0.0, 0.0, 0.0, goal});
  expectYaws(headings(kHook, 0.3, goal, HeadingMode::FORWARD), {kEast, kNorth, kWest, goal});
  expectYaws(headings(kHook, 0.3, goal, HeadingMode::BACKWARD), {kWest, kSouth, kEast, goal});
  expectYaws(headings(kHook, 0.3, goal, HeadingMode::LEFTWARD), {kSouth, kEast, kNorth, goal});
  expectYaws(headings(kHook, 0.3, goal, HeadingMode::RIGHTWARD), {kNorth, kWest, kSouth, goal});
  expectYaws(headings(kHook, 0.0, 0.6, HeadingMode::INTERPOLATE), {0.0, 0.2, 0.4, 0.6});
}

TEST(Headings, InterpolateTurnsByTheSmallerAngle) {
  const std::vector<Eigen::Vector2d> straight = {{0, 0}, {1, 0}, {4, 0}};
  expectYaws(headings(straight, 3.0, -3.0, HeadingMode::INTERPOLATE),
             {3.0, 3.0 + (2 * M_PI - 6.0) / 4, -3.0});
  expectYaws(headings(straight, -3.0, 3.0, HeadingMode::INTERPOLATE),
             {-3.0, -3.0 - (2 * M_PI - 6.0) / 4, 3.0});
  expectYaws(headings(straight, M_PI / 2, -M_PI / 2, HeadingMode::INTERPOLATE),
             {M_PI / 2, 0.75 * M_PI, -M_PI / 2});
}

TEST(Headings, ForwardThenInterpolateTurnsOverTheLastStraightStretch) {
  // The corner is at (2, 0); the stretch north has a pose at a quarter and one at half of it.
  expectYaws(headings({{0, 0}, {2, 0}, {2, 1}, {2, 2}, {2, 4}}, 0.3, M_PI,
                      HeadingMode::FORWARD_THEN_INTERPOLATE),
             {kEast, kNorth, kNorth + M_PI / 8, kNorth + M_PI / 4, M_PI});
}

TEST(Headings, CoincidingPosesLookWhereTheNextOneDoes) {
  const std::vector<Eigen::Vector2d> points = {{0, 0}, {0, 0}, {0, 2}, {0, 2}, {-2, 2}, {-2, 2}};
  expectYaws(headings(points, 0.0, 0.5, HeadingMode::FORWARD),
             {kNorth, kNorth, kWest, kWest, 0.5, 0.5});
  expectYaws(headings(points, 0.0, 0.5, HeadingMode::BACKWARD),
             {kSouth, kSouth, kEast, kEast, 0.5, 0.5});
  expectYaws(headings(points, 0.0, 0.5, HeadingMode::FORWARD_THEN_INTERPOLATE),
             {kNorth, kNorth, kWest, kWest, 0.5, 0.5});
}

TEST(Headings, ForwardThenInterpolateEndsWherePosesBeginToCoincide) {
  expectYaws(
      headings({{0, 0}, {0, 1}, {0, 2}, {0, 2}}, 0.0, M_PI, HeadingMode::FORWARD_THEN_INTERPOLATE),
      {kNorth, 0.75 * M_PI, M_PI, M_PI});
}

TEST(Headings, PathWithoutLength) {
  const std::vector<Eigen::Vector2d> nowhere = {{1, 1}, {1, 1}, {1, 1}};
  expectYaws(headings(nowhere, 0.0, 1.0, HeadingMode::INTERPOLATE), {0.0, 0.5, 1.0});
  expectYaws(headings(nowhere, 0.0, 1.0, HeadingMode::FORWARD), {1.0, 1.0, 1.0});
}

// navigation2#2494: start = goal is a path of one pose.
TEST(Headings, SinglePoseHasTheGoalsYaw) {
  for (const auto& [name, mode] : choicesOf(HeadingMode{}))
    EXPECT_EQ(headings({{3, 4}}, 1.0, -2.5, mode), std::vector<double>{-2.5}) << name;
}

TEST(Headings, EmptyPathStaysEmpty) {
  Path path;
  for (const auto& [name, mode] : choicesOf(HeadingMode{})) applyHeadings(path, 1.0, 2.0, mode);
  for (const auto& [name, mode] : choicesOf(PathZ{})) applyZ(path, 1.0, 2.0, 3.0, mode);
  EXPECT_TRUE(path.empty());
}

Path randomPathWithRepeats(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-50.0, 50.0);
  std::vector<Eigen::Vector2d> points;
  const int count = std::uniform_int_distribution<int>(1, 12)(random);
  for (int i = 0; i < count; ++i) {
    const bool repeat = i > 0 && std::bernoulli_distribution(0.2)(random);
    points.push_back(repeat ? points.back() : Eigen::Vector2d(place(random), place(random)));
  }
  return pathOfWrongYaws(points);
}

// navigation2#2482, #2162: headings missing, the last yaw 0.
TEST(HeadingsLaw, LastYawIsTheGoalsAndAllAreFiniteInEveryMode) {
  std::mt19937 random(2482);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  for (int trial = 0; trial < 300; ++trial) {
    Path path = randomPathWithRepeats(random);
    const Path before = path;
    const double start = angle(random), goal = angle(random);
    for (const auto& [name, mode] : choicesOf(HeadingMode{})) {
      applyHeadings(path, start, goal, mode);
      EXPECT_EQ(path.poses.back().yaw, goal) << name;
      for (std::size_t i = 0; i < path.poses.size(); ++i) {
        EXPECT_LE(std::abs(path.poses[i].yaw), M_PI) << name;
        EXPECT_EQ(path.poses[i].position, before.poses[i].position) << name;
      }
    }
  }
}

TEST(HeadingsLaw, ForwardIsTheTangent) {
  std::mt19937 random(2162);
  for (int trial = 0; trial < 300; ++trial) {
    Path path = randomPathWithRepeats(random);
    applyHeadings(path, 0.0, 0.0, HeadingMode::FORWARD);
    for (std::size_t i = 0; i + 1 < path.poses.size(); ++i) {
      const Eigen::Vector3d step = path.poses[i + 1].position - path.poses[i].position;
      if (step.norm() == 0.0) continue;
      EXPECT_NEAR(std::cos(path.poses[i].yaw) * step.norm(), step.x(), 1e-9 * step.norm());
      EXPECT_NEAR(std::sin(path.poses[i].yaw) * step.norm(), step.y(), 1e-9 * step.norm());
    }
  }
}

TEST(HeadingsLaw, InterpolateNeverTurnsMoreThanHalfRound) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-10.0, 10.0);
  for (int trial = 0; trial < 300; ++trial) {
    Path path = randomPathWithRepeats(random);
    const double start = angle(random), goal = angle(random);
    applyHeadings(path, start, goal, HeadingMode::INTERPOLATE);
    double turned = 0.0;
    for (std::size_t i = 1; i < path.poses.size(); ++i)
      turned += angleBetween(path.poses[i].yaw, path.poses[i - 1].yaw);
    const bool alone = path.poses.size() == 1;
    EXPECT_NEAR(turned, alone ? 0.0 : angleBetween(start, goal), 1e-9);
  }
}

std::vector<double> heights(const std::vector<Eigen::Vector2d>& points, PathZ mode) {
  Path path = pathOfWrongYaws(points);
  applyZ(path, 1.0, 5.0, -7.0, mode);
  std::vector<double> z;
  for (const Pose& pose : path.poses) z.push_back(pose.position.z());
  return z;
}

// A goal without a heading is arrived at without a turn.
TEST(ArrivalYaw, IsThatOfTheLastPiece) {
  const Path path = pathOfWrongYaws({{0, 0}, {1, 0}, {1, 3}, {1, 3}});
  for (const auto& [mode, yaw] :
       {std::pair(HeadingMode::FORWARD, M_PI / 2), std::pair(HeadingMode::BACKWARD, -M_PI / 2),
        std::pair(HeadingMode::LEFTWARD, 0.0), std::pair(HeadingMode::RIGHTWARD, M_PI),
        std::pair(HeadingMode::FORWARD_THEN_INTERPOLATE, M_PI / 2),
        std::pair(HeadingMode::INTERPOLATE, 0.7), std::pair(HeadingMode::NONE, 0.0)}) {
    EXPECT_LT(angleBetween(arrivalYaw(path, 0.7, mode), yaw), 1e-12);
    Path turned = path;
    applyHeadings(turned, 0.7, arrivalYaw(path, 0.7, mode), mode);
    EXPECT_LT(angleBetween(turned.poses[1].yaw, turned.poses[2].yaw), 1e-12);
  }
  EXPECT_EQ(arrivalYaw(pathOfWrongYaws({{1, 1}}), 0.7, HeadingMode::FORWARD), 0.7);
}

TEST(LookAlongPath, GivesTheHeadingsThatAreMissing) {
  Path path = pathOfWrongYaws({{0, 0}, {1, 0}, {1, 3}});
  path.poses[0].yaw = path.poses[2].yaw = std::nan("");
  lookAlongPath(path);
  expectYaws(yawsOf(path), {0.0, 0.123, M_PI / 2});
}

TEST(PathHeight, Modes) {
  const std::vector<Eigen::Vector2d> points = {{0, 0}, {1, 0}, {1, 3}};
  EXPECT_EQ(heights(points, PathZ::INTERPOLATE), (std::vector<double>{1.0, 2.0, 5.0}));
  EXPECT_EQ(heights(points, PathZ::START), (std::vector<double>{1.0, 1.0, 1.0}));
  EXPECT_EQ(heights(points, PathZ::GOAL), (std::vector<double>{5.0, 5.0, 5.0}));
  EXPECT_EQ(heights(points, PathZ::FIXED), (std::vector<double>{-7.0, -7.0, -7.0}));
}

TEST(PathHeight, WithoutLength) {
  EXPECT_EQ(heights({{1, 1}}, PathZ::INTERPOLATE), std::vector<double>{5.0});
  EXPECT_EQ(heights({{1, 1}, {1, 1}, {1, 1}}, PathZ::INTERPOLATE),
            (std::vector<double>{1.0, 3.0, 5.0}));
}

TEST(PathHeight, LengthIsHorizontal) {
  Path path = pathOfWrongYaws({{0, 0}, {1, 0}, {2, 0}});
  path.poses[1].position.z() = 1000.0;
  applyZ(path, 0.0, 4.0, 0.0, PathZ::INTERPOLATE);
  EXPECT_DOUBLE_EQ(path.poses[1].position.z(), 2.0);
}

}  // namespace
}  // namespace grid_path_planner::path
