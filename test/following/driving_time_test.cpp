// How long a drive takes, foretold at its start and compared with the drive itself.
#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "following/closed_loop.h"
#include "following/go_to/driven_track.h"

namespace grid_path_planner::following {

using path::Path;
using path::Pose;

namespace {

using test::ClosedLoop;
using test::pathOf;

// {foretold, driven} in seconds.
std::pair<double, double> timesOf(const Path& path, const FollowerOptions& options = {}) {
  ClosedLoop loop(options);
  EXPECT_EQ(loop.follower.timeRemaining(), std::numeric_limits<double>::infinity());
  loop.follower.start(path, Join::NEAREST);
  loop.step();
  const double foretold = loop.follower.timeRemaining();
  EXPECT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  return {foretold, loop.vehicle.time()};
}

TEST(DrivingTime, OfAStraightLineIsThatOfItsLengthAndOfItsEnd) {
  const auto [foretold, driven] = timesOf(pathOf({{0, 0}, {40, 0}}));
  EXPECT_GT(foretold, 40.0 / 0.8);
  EXPECT_NEAR(foretold, driven, 0.05 * driven);
}

TEST(DrivingTime, KnowsTheLimits) {
  FollowerOptions slow;
  slow.max_speed = 0.2;
  EXPECT_NEAR(timesOf(pathOf({{0, 0}, {8, 0}}), slow).first, 40.0, 4.0);
  FollowerOptions fast;
  fast.max_speed = 2.0;  // where it climbs, the limit is another one
  const auto [foretold, driven] = timesOf(pathOf({{0, 0, 0}, {0.5, 0, 4}}), fast);
  EXPECT_GT(foretold, 10.0);
  EXPECT_NEAR(foretold, driven, 0.15 * driven);
}

TEST(DrivingTime, FallsToNothing) {
  ClosedLoop loop;
  loop.follower.start(pathOf({{0, 0}, {4, 0}, {4, 4}}), Join::NEAREST);
  loop.step();
  double least = loop.follower.timeRemaining();
  loop.each_step = [&] {
    EXPECT_LT(loop.follower.timeRemaining(), least + 0.5);
    least = std::min(least, loop.follower.timeRemaining());
  };
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_LT(least, 1.0);
}

TEST(DrivingTime, OfRandomPathsIsAboutThatOfTheDrive) {
  std::mt19937 random(17);  // NOLINT: the same paths every time
  std::uniform_real_distribution<double> turn(-1.5, 1.5), length(0.5, 5.0);
  for (int trial = 0; trial < 30; ++trial) {
    Path path = pathOf({{0, 0}});
    double heading = 0.0;
    for (int i = 0; i < 8; ++i) {
      heading += turn(random);
      const Eigen::Vector3d step(std::cos(heading), std::sin(heading), 0.0);
      path.poses.push_back({path.poses.back().position + length(random) * step, heading});
    }
    FollowerOptions options;
    options.facing = trial % 2 == 0 ? FacingMode::ALONG : FacingMode::PATH_YAW;
    const auto [foretold, driven] = timesOf(path, options);
    EXPECT_NEAR(foretold, driven, 0.2 * driven + 2.0) << "trial " << trial;
  }
}

// A path of a million poses is foretold five times a second.
TEST(DrivingTime, OfALongPathCostsNoMoreThanItsKnots) {
  Path path;
  for (int i = 0; i <= 100000; ++i) path.poses.push_back({{0.01 * i, 0.0, 0.0}, 0.0});
  ClosedLoop loop;
  loop.follower.start(path, Join::NEAREST);
  loop.step();
  EXPECT_NEAR(loop.follower.timeRemaining(), 1000.0 / 0.8, 10.0);
}

TEST(DrivenTrack, LeadsBackWithTheHeadingsThatItHad) {
  DrivenTrack track;
  for (int i = 0; i <= 100; ++i) track.add({{0.05 * i, 0.0, 0.0}, 0.01 * i});
  const Path back = track.back({{5.02, 0.0, 0.0}, 1.0}, 1.0);
  ASSERT_FALSE(back.empty());
  EXPECT_NEAR(back.poses.back().position.x(), 4.0, 0.2);
  for (std::size_t i = 1; i < back.poses.size(); ++i)
    EXPECT_LT(back.poses[i].position.x(), back.poses[i - 1].position.x());
  EXPECT_NEAR(back.poses.back().yaw, 0.2 * back.poses.back().position.x(), 1e-9);
}

TEST(DrivenTrack, DoesNotLeadBackFromWhereItStandsOrWasCarriedTo) {
  DrivenTrack track;
  EXPECT_TRUE(track.back({}, 1.0).empty());
  for (int i = 0; i < 100; ++i) track.add({{0.001 * (i % 7), 0.0, 0.0}, 0.0});
  EXPECT_TRUE(track.back({}, 1.0).empty()) << "it has stood";
  for (int i = 0; i < 20; ++i) track.add({{0.1 * i, 0.0, 0.0}, 0.0});
  track.add({{50.0, 0.0, 0.0}, 0.0});
  EXPECT_TRUE(track.back({{50.0, 0.0, 0.0}, 0.0}, 1.0).empty()) << "it was carried";
  track.add({{std::nan(""), 0.0, 0.0}, 0.0});
  EXPECT_TRUE(track.back({{50.0, 0.0, 0.0}, 0.0}, 1.0).empty());
}

TEST(DrivenTrack, ForgetsWhatIsFarBehind) {
  DrivenTrack track;
  for (int i = 0; i < 100000; ++i) track.add({{0.1 * i, 0.0, 0.0}, 0.0});
  const Path all = track.back({{0.1 * 99999, 0.0, 0.0}, 0.0}, 1e6);
  EXPECT_LE(all.poses.size(), 501U);
}

}  // namespace
}  // namespace grid_path_planner::following
