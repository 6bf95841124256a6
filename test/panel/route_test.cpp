#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "panel/drive_progress.h"
#include "panel/path_corners.h"
#include "panel/pose_at.h"
#include "panel/route_planning.h"
#include "panel/route_points.h"

namespace grid_path_planner::panel {
namespace {

using path::Path;
using path::Pose;
using test::poseAt;
using Kind = RoutePoints::Kind;

RoutePoints routeOf(int via) {
  RoutePoints points;
  EXPECT_EQ(points.set({Kind::GOAL, 0}, "map", poseAt(10, 0)), "");
  for (int i = 1; i <= via; ++i) EXPECT_EQ(points.addVia("map", poseAt(i, 1)), "");
  return points;
}

PlanAnswer found() {
  PlanAnswer answer;
  answer.status = "FOUND";
  answer.message = "a path";
  answer.path.frame_id = "map";
  answer.path.poses = {poseAt(0, 0), poseAt(10, 0)};
  return answer;
}

TEST(RoutePoints, KeepTheirOrder) {
  RoutePoints points = routeOf(2);
  ASSERT_EQ(points.via().size(), 2U);
  EXPECT_FALSE(points.start());
  EXPECT_EQ(points.via()[1].position, poseAt(2, 1).position);
  EXPECT_EQ(points.goal()->position, poseAt(10, 0).position);
  points.removeLastVia();
  EXPECT_EQ(points.via().size(), 1U);
}

TEST(RoutePoints, RefusesWhatIsNoPlace) {
  RoutePoints points = routeOf(1);
  EXPECT_NE(points.set({Kind::GOAL, 0}, "", poseAt(1, 1)), "");
  EXPECT_NE(points.set({Kind::GOAL, 0}, "map", poseAt(std::nan(""), 1)), "");
  EXPECT_NE(points.set({Kind::START, 0}, "map", poseAt(1e7, 1)), "");
  EXPECT_NE(points.set({Kind::VIA, 1}, "map", poseAt(1, 1)), "");
  EXPECT_EQ(points.goal()->position, poseAt(10, 0).position);
  for (std::size_t i = 1; i < RoutePoints::kMostVia; ++i)
    EXPECT_EQ(points.addVia("map", poseAt(0, 0)), "");
  EXPECT_NE(points.addVia("map", poseAt(0, 0)), "");
}

// rviz's fixed frame was changed: points of the old one would stand elsewhere.
TEST(RoutePoints, APointInAnotherFrameReplacesAll) {
  RoutePoints points = routeOf(2);
  EXPECT_EQ(points.set({Kind::START, 0}, "odom", poseAt(1, 1)), "");
  EXPECT_FALSE(points.goal());
  EXPECT_TRUE(points.via().empty());
  EXPECT_EQ(points.frame(), "odom");
}

TEST(RoutePlanning, AsksOnceForAllPointsAndGivesTheAnswer) {
  RoutePlanning planning;
  planning.ask(routeOf(2), true);
  const auto request = planning.next(0.0);
  ASSERT_TRUE(request);
  EXPECT_EQ(request->points.via().size(), 2U);
  EXPECT_TRUE(request->best_order);
  EXPECT_FALSE(planning.next(0.0)) << "one at a time";
  EXPECT_TRUE(planning.busy());
  EXPECT_TRUE(planning.take(request->id, found(), 0.0));
  EXPECT_FALSE(planning.busy());
  EXPECT_EQ(planning.outcome().path.poses.size(), 2U);
  planning.ask(routeOf(2), false);
  const auto second = planning.next(0.0);
  PlanAnswer failure;
  failure.status = "UNREACHABLE";
  failure.message = "to via-point 2: no path";
  EXPECT_FALSE(second->best_order);
  EXPECT_TRUE(planning.take(second->id, failure, 0.0));
  EXPECT_EQ(planning.outcome().message, failure.message);
  EXPECT_TRUE(planning.outcome().path.empty()) << "nothing is left of the answer before";
}

// A goal is dragged faster than plans are made: the last place counts.
TEST(RoutePlanning, PointsThatMovedAreAskedAnew) {
  RoutePlanning planning;
  planning.ask(routeOf(0), false);
  const auto first = planning.next(0.0);
  RoutePoints moved = routeOf(0);
  for (int x = 1; x < 5; ++x) {
    EXPECT_EQ(moved.set({Kind::GOAL, 0}, "map", poseAt(x, 0)), "");
    planning.ask(moved, false);
    EXPECT_FALSE(planning.next(0.0));
  }
  EXPECT_FALSE(planning.take(first->id, found(), 0.0)) << "nobody wants it any more";
  const auto second = planning.next(0.0);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->points.goal()->position.x(), 4.0);
  EXPECT_TRUE(planning.take(second->id, found(), 0.0));
}

TEST(RoutePlanning, AnswersTwiceLateOrOfOthersArePassedOver) {
  RoutePlanning planning;
  planning.ask(routeOf(0), false);
  const auto request = planning.next(0.0);
  EXPECT_FALSE(planning.take(request->id + 1, found(), 0.0));
  EXPECT_TRUE(planning.take(request->id, found(), 0.0));
  EXPECT_FALSE(planning.take(request->id, found(), 0.0));
}

TEST(RoutePlanning, SilenceIsOverdueAndSignsOfLifeAreNot) {
  RoutePlanning planning;
  planning.ask(routeOf(0), false);
  const auto request = planning.next(100.0);
  EXPECT_FALSE(planning.overdue(100.0 + RoutePlanning::kPatience));
  EXPECT_TRUE(planning.overdue(100.1 + RoutePlanning::kPatience));
  planning.heard(request->id, 105.0);
  EXPECT_FALSE(planning.overdue(104.9 + RoutePlanning::kPatience));
}

TEST(DriveProgress, TimeLeftFollowsTheSpeedOfTheLastSeconds) {
  DriveProgress progress;
  EXPECT_FALSE(progress.share());
  for (int i = 0; i <= 100; ++i) progress.add(0.1 * i, 20.0 - 0.05 * i);  // 0.5 m/s
  ASSERT_TRUE(progress.secondsLeft());
  EXPECT_NEAR(*progress.secondsLeft(), 30.0, 1e-6);
  EXPECT_NEAR(*progress.share(), 0.25, 1e-9);
}

TEST(DriveProgress, AVehicleThatStandsHasNoTimeLeft) {
  DriveProgress progress;
  for (int i = 0; i < 100; ++i) progress.add(i, 20.0);
  EXPECT_FALSE(progress.secondsLeft());
}

TEST(DriveProgress, BeginsAnewForAnotherDriveAndWhereTimeGoesBack) {
  DriveProgress progress;
  progress.add(0.0, 10.0);
  progress.add(5.0, 5.0);
  progress.add(6.0, 20.0);
  EXPECT_FALSE(progress.secondsLeft());
  EXPECT_EQ(*progress.share(), 0.0);
  progress.add(1.0, 19.0);
  EXPECT_FALSE(progress.secondsLeft());
  progress.add(2.0, std::nan(""));
  EXPECT_FALSE(progress.share());
}

TEST(PathCorners, KeepsTheTurnsOnly) {
  Path path;
  for (int i = 0; i <= 10; ++i) path.poses.push_back(poseAt(i, 0));
  for (int i = 1; i <= 10; ++i) path.poses.push_back(poseAt(10, 0.1 * i));
  const Path corners = cornersOf(path);
  ASSERT_EQ(corners.poses.size(), 3U);
  EXPECT_EQ(corners.poses[1].position, poseAt(10, 0).position);
  EXPECT_TRUE(cornersOf(Path()).empty());
}

// A law: whatever the path, also one that turns back on its line or stands, no pose is farther from
// the line through the corners than a micrometre for each pose that is left out.
TEST(PathCorners, TheLineStays) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> step(-1, 1);
  for (int round = 0; round < 500; ++round) {
    Path path;
    path.poses = {poseAt(0, 0)};
    for (int i = 0; i < 60; ++i) {
      const auto& last = path.poses.back().position;
      path.poses.push_back(poseAt(last.x() + step(random), last.y() + step(random)));
    }
    const Path corners = cornersOf(path);
    for (const Pose& pose : path.poses) {
      double nearest = 1e9;
      for (std::size_t i = 1; i < corners.poses.size(); ++i) {
        const Eigen::Vector3d from = corners.poses[i - 1].position;
        const Eigen::Vector3d line = corners.poses[i].position - from;
        const double t =
            line.squaredNorm() > 0.0
                ? std::clamp((pose.position - from).dot(line) / line.squaredNorm(), 0.0, 1.0)
                : 0.0;
        nearest = std::min(nearest, (pose.position - from - t * line).norm());
      }
      ASSERT_LT(nearest, 1e-4);
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::panel
