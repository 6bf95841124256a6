// A user's driver went from pose to pose: with smoothed paths it had nine poses for twenty metres,
// and cut across the room between them.
#include "path/pose_spacing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_path_planner/path/metrics.h"
#include "support/path_through.h"

namespace grid_path_planner::path {
namespace {

Path withHeadings(const std::vector<Eigen::Vector2d>& points, double start_yaw, double goal_yaw,
                  HeadingMode mode) {
  Path path = test::pathThrough(points);
  applyZ(path, 1.0, 3.0, 0.0, PathZ::INTERPOLATE);
  applyHeadings(path, start_yaw, goal_yaw, mode);
  return path;
}

TEST(SpacedPoses, StandInEqualPartsBetweenCorners) {
  const Path path = withHeadings({{0, 0}, {1, 0}, {1, 0.3}}, 0.0, 0.0, HeadingMode::FORWARD);
  const Path spaced = spacedPoses(path, 0.4, HeadingMode::FORWARD);
  ASSERT_EQ(spaced.poses.size(), 5U);
  EXPECT_NEAR(spaced.poses[1].position.x(), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(spaced.poses[2].position.x(), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(spaced.poses[2].position.z(), 1.0 + 2.0 * (2.0 / 3.0) / 1.3, 1e-12);
  EXPECT_EQ(spaced.poses[2].yaw, 0.0);
  EXPECT_NEAR(spaced.poses[3].yaw, M_PI / 2, 1e-12);
  EXPECT_EQ(spacedPoses(path, 0.0, HeadingMode::FORWARD).poses.size(), 3U) << "corners only";
  EXPECT_EQ(spacedPoses(path, -1.0, HeadingMode::FORWARD).poses.size(), 3U);
  EXPECT_TRUE(spacedPoses(Path(), 0.1, HeadingMode::FORWARD).empty());
}

TEST(SpacedPoses, AreBoundedInNumber) {
  const Path path = withHeadings({{0, 0}, {1e6, 0}}, 0.0, 0.0, HeadingMode::FORWARD);
  EXPECT_LE(spacedPoses(path, 1e-9, HeadingMode::FORWARD).poses.size(), 1000002U);
}

// Spaced, a path keeps its corners, its line and its turning, and its headings are those that the
// mode gives to the poses.
TEST(SpacedPoses, KeepTheLine) {
  std::mt19937 random(20261122);
  std::uniform_real_distribution<double> coordinate(-10.0, 10.0), angle(-3.0, 3.0);
  for (int trial = 0; trial < 300; ++trial) {
    const HeadingMode mode = choicesOf(HeadingMode{})[random() % 7].second;
    std::vector<Eigen::Vector2d> points;
    for (std::size_t i = 0; i < 2 + random() % 6; ++i)
      points.emplace_back(coordinate(random), coordinate(random));
    if (random() % 4 == 0) points.push_back(points.back());
    const Path path = withHeadings(points, angle(random), angle(random), mode);
    const double spacing = 0.01 + 0.001 * (random() % 4000);
    const Path spaced = spacedPoses(path, spacing, mode);
    SCOPED_TRACE(trial);
    EXPECT_EQ(spaced.frame_id, path.frame_id);
    EXPECT_NEAR(lengthOf(spaced), lengthOf(path), 1e-9);
    EXPECT_NEAR(turningOf(spaced), turningOf(path), 1e-6);
    std::size_t corner = 0;
    for (std::size_t i = 0; i < spaced.poses.size(); ++i) {
      const Pose& pose = spaced.poses[i];
      if (corner < path.poses.size() && pose.position == path.poses[corner].position) {
        EXPECT_NEAR(std::remainder(pose.yaw - path.poses[corner].yaw, 2.0 * M_PI), 0.0, 1e-6);
        ++corner;
      }
      const Pose& before = spaced.poses[i > 0 ? i - 1 : 0];
      EXPECT_LE((pose.position - before.position).head<2>().norm(), spacing * (1.0 + 1e-6));
    }
    EXPECT_EQ(corner, path.poses.size()) << "every corner is there, in order";
  }
}

}  // namespace
}  // namespace grid_path_planner::path
