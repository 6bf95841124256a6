// Laws of waypoint files: what comes back, and what damage does.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::path {

using base::InputError;

namespace {

using test::contains;
using test::contentOf;
using test::TemporaryFolder;

Path pathOfRandomNumbers(std::mt19937& random) {
  std::uniform_real_distribution<double> yaw(-M_PI, M_PI), exponent(-12.0, 6.0), sign(-1.0, 1.0);
  Path path;
  path.poses.resize(std::uniform_int_distribution<int>(1, 30)(random));
  for (Pose& pose : path.poses) {
    for (int axis = 0; axis < 3; ++axis)
      pose.position[axis] = std::copysign(std::pow(10.0, exponent(random)), sign(random));
    pose.yaw = yaw(random);
  }
  return path;
}

Path oneWaypoint(double x, double y, double yaw) {
  Path path;
  path.poses.resize(1);
  path.poses[0].position << x, y, 0.0;
  path.poses[0].yaw = yaw;
  return path;
}

// follow_waypoints#20, navigation2#2688: a round trip loses nothing that a vehicle could tell. 17 digits
// of noise made files that nobody could read, and another file of every path that was saved again.
TEST(WaypointFileLaw, ReadAndWrittenAgainItIsTheSameToTheByte) {
  std::mt19937 random(2688);
  const TemporaryFolder folder;
  const std::string file = folder.path("path.yaml"), second = folder.path("again.yaml");
  for (int trial = 0; trial < 300; ++trial) {
    const Path path = pathOfRandomNumbers(random);
    writeWaypointFile(file, path);
    const Path again = readWaypointFile(file).path;
    ASSERT_EQ(again.poses.size(), path.poses.size());
    for (std::size_t i = 0; i < path.poses.size(); ++i) {
      EXPECT_LE((again.poses[i].position - path.poses[i].position).cwiseAbs().maxCoeff(), 0.51e-6);
      EXPECT_NEAR(std::remainder(again.poses[i].yaw - path.poses[i].yaw, 2 * M_PI), 0.0, 4e-9);
    }
    writeWaypointFile(second, again);
    ASSERT_EQ(contentOf(second), contentOf(file));
  }
}

TEST(WaypointFileLaw, ExtremeNumbersComeBack) {
  const TemporaryFolder folder;
  const std::string file = folder.path("path.yaml");
  for (const double x : {0.0, 1e6, 999999.999999, 0.3, 1e-6, 123456.0}) {
    writeWaypointFile(file, oneWaypoint(x, -x, M_PI));
    const Pose pose = readWaypointFile(file).path.poses[0];
    EXPECT_EQ(pose.position.x(), x);
    EXPECT_EQ(pose.position.y(), -x);
    EXPECT_EQ(std::abs(pose.yaw), M_PI);
  }
  for (const double x : {-0.0, std::numeric_limits<double>::min(), -4e-7}) {
    writeWaypointFile(file, oneWaypoint(x, 0, 7.0));
    const Pose pose = readWaypointFile(file).path.poses[0];
    EXPECT_EQ(pose.position.x(), 0.0);
    EXPECT_FALSE(std::signbit(pose.position.x()));
    EXPECT_NEAR(pose.yaw, 7.0 - 2 * M_PI, 4e-9);
  }
}

// A copy that broke off anywhere is refused, or is the whole entries before the break.
TEST(WaypointFileLaw, TruncatedFilesNeverInventAWaypoint) {
  std::mt19937 random(3165);
  const TemporaryFolder folder;
  Path path = pathOfRandomNumbers(random);
  path.poses.resize(4);
  const std::string file = folder.path("path.yaml");
  writeWaypointFile(file, path);
  const std::string whole = contentOf(file);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    folder.write("path.yaml", whole.substr(0, length));
    try {
      const Path part = readWaypointFile(file).path;
      ASSERT_LE(part.poses.size(), path.poses.size());
      for (std::size_t i = 0; i < part.poses.size(); ++i)
        EXPECT_LE((part.poses[i].position - path.poses[i].position).norm(), 1e-6) << length;
    } catch (const InputError& error) {
      EXPECT_TRUE(contains(error.what(), "path.yaml"));
    }
  }
}

TEST(WaypointFileLaw, RandomDamageIsRefusedOrHarmless) {
  std::mt19937 random(180);
  const TemporaryFolder folder;
  const std::string file = folder.path("path.yaml");
  Path path = pathOfRandomNumbers(random);
  writeWaypointFile(file, path);
  const std::string whole = contentOf(file);
  const std::string letters = "{}[]:,-#&*!|>'\"%@`\n\t 019.eE\\x";
  for (int trial = 0; trial < 500; ++trial) {
    std::string damaged = whole;
    for (int i = 0; i <= trial % 3; ++i)
      damaged[random() % damaged.size()] = letters[random() % letters.size()];
    folder.write("path.yaml", damaged);
    try {
      for (const Pose& pose : readWaypointFile(file).path.poses)
        EXPECT_LE(pose.position.cwiseAbs().maxCoeff(), kLargestElsewhere) << damaged;
    } catch (const InputError& error) {
      EXPECT_TRUE(contains(error.what(), "path.yaml"));
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::path
