#include "path/waypoint_formats/local_tangent_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::path {
namespace {

// The Matterhorn from Zermatt, as textbooks of mapping have it: -7134.8, -4556.3, 2852.4.
TEST(LocalTangentPlane, AKnownPlace) {
  const LocalTangentPlane plane({{46.017, 7.750, 1673.0}, 0.0});
  const Eigen::Vector3d position = plane.positionOf({45.976, 7.658, 4531.0});
  EXPECT_NEAR(position.x(), -7134.8, 0.05);
  EXPECT_NEAR(position.y(), -4556.3, 0.05);
  EXPECT_NEAR(position.z(), 2852.4, 0.05);
}

// An arc second of latitude at the equator is 30.715 m long, one of longitude 30.922 m.
TEST(LocalTangentPlane, AnArcSecondAtTheEquator) {
  const LocalTangentPlane plane({{0.0, 10.0, 0.0}, 0.0});
  EXPECT_NEAR(plane.positionOf({1.0 / 3600, 10.0, 0.0}).y(), 30.715, 1e-3);
  EXPECT_NEAR(plane.positionOf({0.0, 10.0 + 1.0 / 3600, 0.0}).x(), 30.922, 1e-3);
}

TEST(LocalTangentPlane, TheYawTurnsTheMap) {
  const LocalTangentPlane plane({{53.0, 8.0, 0.0}, M_PI / 2});  // x points north
  const Eigen::Vector3d north = plane.positionOf({53.001, 8.0, 0.0});
  EXPECT_GT(north.x(), 100.0);
  EXPECT_NEAR(north.y(), 0.0, 1e-6);
}

TEST(LocalTangentPlane, ThereAndBackIsTheIdentity) {
  std::mt19937 random(84);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (int round = 0; round < 500; ++round) {
    const LocalTangentPlane plane(
        {{90.0 * share(random), 180.0 * share(random), 5000.0 * share(random)},
         3.0 * share(random)});
    const Eigen::Vector3d position =
        1e6 * share(random) * Eigen::Vector3d(share(random), share(random), 0.1 * share(random));
    const Eigen::Vector3d again = plane.positionOf(plane.geodeticOf(position));
    EXPECT_LT((again - position).norm(), 1e-7) << "round " << round;
  }
}

TEST(LocalTangentPlane, RefusesWhatIsNoPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(LocalTangentPlane({{90.1, 0.0, 0.0}, 0.0}), base::InputError);
  EXPECT_THROW(LocalTangentPlane({{0.0, 361.0, 0.0}, 0.0}), base::InputError);
  EXPECT_THROW(LocalTangentPlane({{0.0, 0.0, 0.0}, nan}), base::InputError);
  EXPECT_THROW(LocalTangentPlane({{nan, 0.0, 0.0}, 0.0}), base::InputError);
}

}  // namespace
}  // namespace grid_path_planner::path
