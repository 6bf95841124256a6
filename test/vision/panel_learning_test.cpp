#include "vision/panel_learning.h"

#include <gtest/gtest.h>

#include <random>

#include "support/error_text.h"
#include "vision/panel_views.h"

namespace grid_path_planner::vision {
namespace {

using Eigen::Isometry3d, Eigen::Vector3d;
using test::contains, test::errorText;

const Isometry3d kMapFromPanel =
    Eigen::Translation3d(4.05, -0.55, 2.9) * Eigen::AngleAxisd(0.42, Vector3d::UnitZ());
const Isometry3d kBaseFromCamera =
    Eigen::Translation3d(0.3, 0.05, -0.1) * Eigen::AngleAxisd(0.2, Vector3d::UnitY());

// A vehicle before the panel whose camera's pose is off by `error` (covariance coordinates).
PanelSighting seen(double time, const Isometry3d& panel_from_camera, const Vector6& error,
                   const Matrix6& covariance = Matrix6::Identity()) {
  PoseEstimate pose;
  pose.panel_from_camera = panel_from_camera;
  pose.panel_from_camera.pretranslate(Vector3d(error.head<3>()));
  const Vector3d turn = error.tail<3>();
  if (turn.norm() > 0.0)
    pose.panel_from_camera.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  pose.covariance = covariance;
  return sightingOf(time, kMapFromPanel * panel_from_camera * kBaseFromCamera.inverse(),
                    kBaseFromCamera, pose);
}

PanelSightings sightingsOf(int count, double period = 0.2) {
  PanelSightings sightings{PanelLearningOptions()};
  for (int i = 0; i < count; ++i)
    sightings.add(seen(period * i, lookingAt({0.2, -2.0, 0.1}, {0.0, 0.0, 0.0}), Vector6::Zero()));
  return sightings;
}

TEST(PanelLearning, ThePanelIsWhereExactPosesHaveIt) {
  const PanelPose panel = sightingsOf(10).learnt();
  EXPECT_LT(differenceOf(panel.map_from_panel, kMapFromPanel).norm(), 1e-9);
}

// The covariance of a panel as it is seen: by differences of what exact poses and slightly wrong ones give.
TEST(PanelLearning, ErrorsOfTheCameraBecomeThoseOfThePanelAsTheCovarianceSays) {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const Isometry3d pose = randomPose(random);
    Matrix6 jacobian;
    constexpr double kStep = 1e-6;
    for (int axis = 0; axis < 6; ++axis) {
      const Vector6 error = kStep * Vector6::Unit(axis);
      jacobian.col(axis) =
          differenceOf(seen(0.0, pose, error).panel.map_from_panel, kMapFromPanel) / kStep;
    }
    const Matrix6 expected = jacobian * jacobian.transpose();
    EXPECT_LT((seen(0.0, pose, Vector6::Zero()).panel.covariance - expected).norm(), 1e-3) << i;
  }
}

TEST(PanelLearning, NoiseAveragesOut) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.003);
  PanelLearningOptions options;
  options.images = 100;
  PanelSightings sightings(options);
  for (int i = 0; i < 100; ++i) {
    Vector6 error;
    for (int axis = 0; axis < 6; ++axis) error[axis] = noise(random);
    sightings.add(seen(0.2 * i, lookingAt({0.2, -2.0, 0.1}, {0.0, 0.0, 0.0}), error));
  }
  EXPECT_LT(differenceOf(sightings.learnt().map_from_panel, kMapFromPanel).norm(), 0.003);
}

TEST(PanelLearning, ItTakesImagesInARow) {
  EXPECT_EQ(errorText([] { sightingsOf(9).learnt(); }),
            "it takes 10 images with a pose, so far there are 9");
  EXPECT_EQ(errorText([] { sightingsOf(20, 2.5).learnt(); }),
            "it takes 10 images with a pose, so far there are 1");
}

TEST(PanelLearning, AVehicleThatMovesLearnsNothing) {
  PanelSightings sightings = sightingsOf(9);
  sightings.add(seen(1.8, lookingAt({0.3, -2.0, 0.1}, {0.1, 0.0, 0.0}), Vector6::Zero()));
  EXPECT_TRUE(contains(errorText([&] { sightings.learnt(); }), "the vehicle moved by 0.1 m"));
  // What moved is forgotten after as many images as it takes.
  for (int i = 0; i < 10; ++i)
    sightings.add(
        seen(2.0 + 0.2 * i, lookingAt({0.3, -2.0, 0.1}, {0.1, 0.0, 0.0}), Vector6::Zero()));
  EXPECT_NO_THROW(sightings.learnt());
}

TEST(PanelLearning, APanelThatSeemsToMoveIsNotLearnt) {
  PanelSightings sightings = sightingsOf(9);
  sightings.add(seen(1.8, lookingAt({0.2, -2.0, 0.1}, {0.0, 0.0, 0.0}), 0.2 * Vector6::Unit(1)));
  EXPECT_TRUE(contains(errorText([&] { sightings.learnt(); }), "the panel moved by 0.2 m"));
}

}  // namespace
}  // namespace grid_path_planner::vision
