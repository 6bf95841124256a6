#include "trials/pose_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace grid_path_planner::trials {
namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;

std::vector<Vector3d> alongX(const std::vector<double>& places) {
  std::vector<Vector3d> positions;
  for (const double x : places) positions.emplace_back(x, 0.0, 0.0);
  return positions;
}

// A metre a second along x, `scale` times as far, in a frame that is turned by `turn` about z.
PoseTrack straight(int poses, double scale = 1.0, double turn = 0.0) {
  const Quaterniond turned(AngleAxisd(turn, Vector3d::UnitZ()));
  PoseTrack track;
  for (int i = 0; i < poses; ++i)
    track.push_back({static_cast<double>(i), turned * Vector3d(scale * i, 0.0, 0.0), turned});
  return track;
}

TEST(Smoothness, IsTheCorrelationOfAnIncrementWithTheNext) {
  // Increments 1, 0, 1, 0, 1, 0: five products of -1/4 over six squares of 1/4.
  EXPECT_NEAR(smoothnessOf(alongX({0, 1, 1, 2, 2, 3, 3})), -5.0 / 6.0, 1e-12);
  // Increments 0, 0, 1, 1 about 1/2: (1 - 1 + 1) / 4.
  EXPECT_NEAR(smoothnessOf(alongX({0, 0, 0, 1, 2})), 0.25, 1e-12);
  EXPECT_EQ(smoothnessOf(alongX({0, 1, 2, 3})), 0.0);
  EXPECT_TRUE(std::isnan(smoothnessOf(alongX({0, 1})))) << "one increment has no next one";
  EXPECT_TRUE(std::isnan(smoothnessOf({})));
}

TEST(Smoothness, IsZeroOfARandomWalkAndMinusAHalfOfNoise) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<Vector3d> noise, walk = {Vector3d::Zero()};
  for (int i = 0; i < 20000; ++i) {
    noise.emplace_back(normal(random), normal(random), normal(random));
    walk.push_back(walk.back() + noise.back());
  }
  EXPECT_NEAR(smoothnessOf(walk), 0.0, 0.02);
  EXPECT_NEAR(smoothnessOf(noise), -0.5, 0.02);
}

TEST(PoseErrors, AreADistanceAndAnAngleWhateverTheSignOfTheQuaternion) {
  const Quaterniond turned(AngleAxisd(0.5 * M_PI, Vector3d::UnitY()));
  for (const double sign : {1.0, -1.0}) {
    const PoseError error = errorOf({3.0, 4.0, 0.0}, Quaterniond(sign * turned.coeffs()),
                                    Vector3d::Zero(), Quaterniond::Identity());
    EXPECT_NEAR(error.metres, 5.0, 1e-12);
    EXPECT_NEAR(error.degrees, 90.0, 1e-9);
  }
}

TEST(AbsoluteError, IsTheRootMeanSquareOfTheDistances) {
  PoseTrack estimate = straight(2);
  estimate[1].position += Vector3d(0.0, 3.0, 4.0);
  EXPECT_NEAR(absoluteError(estimate, straight(2)), std::sqrt(12.5), 1e-12);
  EXPECT_EQ(absoluteError(straight(5), straight(5)), 0.0);
}

TEST(RelativeError, OfAScaleErrorGrowsWithTheLength) {
  const PoseTrack truth = straight(12), estimate = straight(12, 1.1);
  EXPECT_NEAR(relativeError(estimate, truth, 1.0)->metres, 0.1, 1e-9);
  EXPECT_NEAR(relativeError(estimate, truth, 5.0)->metres, 0.5, 1e-9);
  EXPECT_NEAR(relativeError(estimate, truth, 5.0)->degrees, 0.0, 1e-9);
  EXPECT_FALSE(relativeError(estimate, truth, 12.0));
}

// Which frame a trajectory is in does not matter to its motion.
TEST(RelativeError, IsNoneInAnotherFrame) {
  const auto error = relativeError(straight(12, 1.0, 0.7), straight(12), 5.0);
  EXPECT_NEAR(error->metres, 0.0, 1e-9);
  EXPECT_NEAR(error->degrees, 0.0, 1e-6);
}

TEST(RelativeError, SeesATurn) {
  PoseTrack estimate = straight(3);
  estimate[2].attitude = AngleAxisd(0.1, Vector3d::UnitX());
  const auto error = relativeError(estimate, straight(3), 1.0);
  EXPECT_NEAR(error->degrees, 0.1 * 180.0 / M_PI / std::sqrt(2.0), 1e-9);
}

TEST(TumText, IsTimePositionAndQuaternionWithItsRealPartLast) {
  const PoseTrack track = {
      {1.5, {1.0, -2.0, 0.25}, Quaterniond(AngleAxisd(M_PI, Vector3d::UnitZ()))}};
  EXPECT_EQ(tumText(track),
            "1.500000 1.000000000 -2.000000000 0.250000000 "
            "0.000000000 0.000000000 1.000000000 0.000000000\n");
}

}  // namespace
}  // namespace grid_path_planner::trials
