#include "trials/trial_run.h"

#include <gtest/gtest.h>

#include "trials/panel_drive.h"
#include "trials/report/trial_findings.h"

namespace grid_path_planner::trials {
namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;

TEST(Nees, IsOneForEachErrorOfOneDeviation) {
  localization::Estimate estimate;
  localization::ErrorVector error;
  for (int i = 0; i < localization::kErrors; ++i) {
    error[i] = 0.01 * (i + 1);
    estimate.covariance(i, i) = error[i] * error[i];
  }
  const auto truth = localization::retract<double>(estimate.state, error);
  EXPECT_NEAR(neesOf(estimate, truth).all, 15.0, 1e-9);
  EXPECT_NEAR(neesOf(estimate, truth).pose, 6.0, 1e-9);
  estimate.covariance *= 4.0;
  EXPECT_NEAR(neesOf(estimate, truth).all, 15.0 / 4.0, 1e-9);
}

TEST(SequentialMean, OfTwoIsHalfwayAndOfMoreHangsOnTheirOrder) {
  const Quaterniond none = Quaterniond::Identity();
  const Quaterniond x(AngleAxisd(1.0, Vector3d::UnitX())), y(AngleAxisd(2.0, Vector3d::UnitY()));
  EXPECT_NEAR(sequentialMean({none, x}).angularDistance(none), 0.5, 1e-12);
  const Quaterniond one = sequentialMean({none, x, y}), other = sequentialMean({y, x, none});
  EXPECT_GT(one.angularDistance(other), 0.02);
}

TEST(PanelDrive, FacesThePanelButWhereItLooksAway) {
  Eigen::Isometry3d panel(Eigen::Translation3d(4.05, -0.55, 2.9));
  panel.rotate(AngleAxisd(0.42, Vector3d::UnitZ()));
  const DriveOptions options;
  const PanelDrive drive(options, panel);
  double side = 0.0, nearest = 1e9, farthest = 0.0;
  for (double t = 0.0; t < options.seconds; t += 0.5) {
    const auto state = drive.stateAt(t);
    const Vector3d in_panel = panel.inverse() * state.position;
    side = std::max(side, std::abs(std::atan2(in_panel.x(), -in_panel.y())));
    nearest = std::min(nearest, in_panel.head<2>().norm());
    farthest = std::max(farthest, in_panel.head<2>().norm());
    const Vector3d ahead(std::cos(state.yaw), std::sin(state.yaw), 0.0);
    const Vector3d to_panel =
        (panel.translation() - state.position).cwiseProduct(Vector3d(1, 1, 0));
    const double off = std::acos(std::clamp(ahead.dot(to_panel.normalized()), -1.0, 1.0));
    EXPECT_TRUE(drive.looksAway(t) || off < 1e-6) << t;
  }
  EXPECT_NEAR(side * 180.0 / M_PI, 45.8, 0.1);
  EXPECT_NEAR(nearest, 1.7, 0.01);
  EXPECT_NEAR(farthest, 3.3, 0.01);
  EXPECT_TRUE(drive.looksAway(106.0));
}

TEST(PanelDrive, GoesAsFastAsItSays) {
  const PanelDrive drive({}, Eigen::Isometry3d::Identity());
  constexpr double kStep = 0.01;
  for (double t = 1.0; t < 250.0; t += 7.3) {
    const auto before = drive.stateAt(t - kStep), now = drive.stateAt(t),
               after = drive.stateAt(t + kStep);
    const Vector3d speed = (after.position - before.position) / (2.0 * kStep);
    EXPECT_LT((base::inMap(now.velocity, now.yaw) - speed).norm(), 1e-4) << t;
    EXPECT_NEAR(now.velocity.yaw_rate,
                std::remainder(after.yaw - before.yaw, 2.0 * M_PI) / (2.0 * kStep), 1e-3);
    EXPECT_NEAR(now.roll_rate, (after.roll - before.roll) / (2.0 * kStep), 1e-4);
    EXPECT_NEAR(now.pitch_rate, (after.pitch - before.pitch) / (2.0 * kStep), 1e-4);
  }
}

// Two frames from nearly the same place, a third without a pose.
class ThreeFrames : public testing::Test {
 protected:
  ThreeFrames() {
    study.sets.resize(1);
    for (int i = 0; i < 3; ++i) {
      SeenFrame frame{i, Water::TURBID, {{}}};
      if (i < 2)
        frame.solutions[0].mean = CameraPose{Vector3d(0.1 * i, -2.0, 0.0), Quaterniond::Identity()};
      frames.push_back(frame);
    }
  }
  TrialStudy study;
  std::vector<SeenFrame> frames;
};

TEST_F(ThreeFrames, AnErrorPutOnTheTruthIsThePoseThatWasSeen) {
  const MarkerErrors errors(study, frames);
  const auto error = errors.shown(0, Method::MEAN, 1);
  ASSERT_TRUE(error);
  Eigen::Isometry3d pose = errors.truth(1);
  pose.translate(Vector3d(error->error.head<3>()));
  const Vector3d turn = error->error.tail<3>();
  pose.rotate(localization::expSO3<double>(turn));
  EXPECT_LT((pose.translation() - Vector3d(0.1, -2.0, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(AngleAxisd(pose.linear()).angle(), 0.0, 1e-7);
}

TEST_F(ThreeFrames, DrawsAreFromNeighboursAndNoneWhereTheImageShowedNone) {
  const MarkerErrors errors(study, frames);
  Noise noise(1, Purpose::MARKERS);
  EXPECT_FALSE(errors.drawn(0, Method::MEAN, 2, noise));
  EXPECT_FALSE(errors.drawn(0, Method::JOINT, 0, noise));
  int own = 0;
  for (int i = 0; i < 200; ++i) {
    const auto drawn = errors.drawn(0, Method::MEAN, 0, noise);
    ASSERT_TRUE(drawn);
    own += drawn->error == errors.shown(0, Method::MEAN, 0)->error;
  }
  EXPECT_GT(own, 20);
  EXPECT_LT(own, 180);
}

// A set with noise of the corners; the error of frame 1 is two deviations of its own covariance, and of no other.
class NoisyCorners : public ThreeFrames {
 protected:
  NoisyCorners() {
    study.sets[0].corner_noise = 0.5;
    for (int i = 0; i < 2; ++i) {
      const Eigen::Isometry3d truth = MarkerErrors(study, frames).truth(i);
      const double deviation = 0.001 * (i + 1);
      JointPose joint{
          {truth * Vector3d(0.0, 0.0, 2.0 * i * deviation), Quaterniond(truth.linear())},
          vision::Matrix6::Identity() * deviation * deviation};
      frames[static_cast<std::size_t>(i)].solutions[0].joint = joint;
    }
  }
};

TEST_F(NoisyCorners, AreDrawnFromAllFramesInDeviationsOfTheirOwn) {
  const MarkerErrors errors(study, frames);
  Noise noise(1, Purpose::MARKERS);
  EXPECT_FALSE(errors.drawn(0, Method::JOINT, 2, noise));
  int off = 0;
  for (int i = 0; i < 200; ++i) {
    const auto drawn = errors.drawn(0, Method::JOINT, 0, noise);
    ASSERT_TRUE(drawn);
    EXPECT_EQ(drawn->covariance, errors.shown(0, Method::JOINT, 0)->covariance);
    const double deviations = drawn->error.z() / 0.001;
    EXPECT_LT(std::min(std::abs(deviations), std::abs(deviations - 2.0)), 1e-6) << deviations;
    off += deviations > 1.0;
  }
  EXPECT_GT(off, 60);
  EXPECT_LT(off, 140);
}

TEST(TrialRecord, IsReadAsItWasWritten) {
  SeenFrame frame{7, Water::CLEAR, {{}, {}}};
  frame.solutions[1].markers = 3;
  frame.solutions[1].mean = CameraPose{{0.1, 1.0 / 3.0, -2.0}, Quaterniond(0.6, 0.8, 0.0, 0.0)};
  frame.solutions[1].joint = JointPose{*frame.solutions[1].mean, vision::Matrix6::Random()};
  frame.solutions[1].panel = {{0.1, 2.0}, {0.2, 3.0}, PoseError{0.3, 4.0}};
  EXPECT_EQ(lineOf(frameFromLine(lineOf(frame))), lineOf(frame));
  EXPECT_EQ(frameFromLine(lineOf(frame)).solutions[1].joint->covariance,
            frame.solutions[1].joint->covariance);
  RunRecord run{1, 9, {RowResult()}};
  run.rows[0].markers = {0.1, 0.2, 3.0, 4.0, 5};
  run.rows[0].rpe[1] = PoseError{0.5, 0.25};
  run.rows[0].nees = {14.0, 1.0 / 8.0};
  EXPECT_EQ(lineOf(runFromLine(lineOf(run))), lineOf(run));
  EXPECT_EQ(runFromLine(lineOf(run)).rows[0].nees, run.rows[0].nees);
  EXPECT_FALSE(isFrameLine(lineOf(run)));
  EXPECT_THROW(runFromLine("{}"), base::InputError);
}

// Of {1, 3} the deviation of one is the root of 2, so that of the mean is 1.
TEST(MeanOf, HasAStandardErrorOfMoreThanOneRun) {
  EXPECT_NEAR(meanOf({1.0, 3.0}).standard_error, 1.0, 1e-12);
  EXPECT_NEAR(meanOf({1.0, 3.0, 1.0, 3.0, 1.0, 3.0, 1.0, 3.0, 1.0, 3.0}).standard_error, 1.0 / 3.0,
              1e-12);
  EXPECT_EQ(meanOf({5.0}).standard_error, 0.0);
}

// Of 50 throws of a coin 18 to 32 are heads by chance.
TEST(Verdict, OfATendencyIsThatOfMoreRunsThanByChance) {
  EXPECT_EQ(verdictOfTendency(33, 50), PredictionVerdict::CONFIRMED);
  EXPECT_EQ(verdictOfTendency(32, 50), PredictionVerdict::UNDECIDED);
  EXPECT_EQ(verdictOfTendency(18, 50), PredictionVerdict::UNDECIDED);
  EXPECT_EQ(verdictOfTendency(17, 50), PredictionVerdict::REFUTED);
  EXPECT_EQ(verdictOfTendency(0, 0), PredictionVerdict::UNDECIDED);
}

// Blocks of two: -3, -1, -3 have a mean of -2.33 and a standard error of 0.67; the last value fills none.
TEST(Verdict, OfAMeanIsByBlocksOfNeighbours) {
  EXPECT_EQ(verdictOfMean({-4, -2, -1, -1, -3, -3, 90}, 2), PredictionVerdict::CONFIRMED);
  EXPECT_EQ(verdictOfMean({4, 2, 1, 1, 3, 3}, 2), PredictionVerdict::REFUTED);
  EXPECT_EQ(verdictOfMean({-4, -2, 1, 1, -3, -3}, 2), PredictionVerdict::UNDECIDED);
  EXPECT_EQ(verdictOfMean({-4, -2, -1}, 2), PredictionVerdict::UNDECIDED) << "one block";
}

TEST(Consistency, CountsTheSecondsInsideTheBoundsOfTheMean) {
  TrialStudy study;
  study.sets.resize(1);
  TrialData data{study, {}, {}, 0};
  for (int seed = 0; seed < 3; ++seed) {  // seed 0 is that of the images, and does not count
    RunRecord run{0, seed, std::vector<RowResult>(1)};
    run.rows[0].nees =
        seed == 0 ? std::vector<double>{900.0, 900.0} : std::vector<double>{15.0, 40.0};
    run.rows[0].pose_nees = {6.0, 6.0};
    data.runs.push_back(run);
  }
  const Consistency consistency = consistencyOf(data, 0, 0);
  EXPECT_NEAR(consistency.mean, 27.5, 1e-12);
  EXPECT_NEAR(consistency.inside, 0.5, 1e-12);
  EXPECT_NEAR(consistency.pose_mean, 6.0, 1e-12);
  EXPECT_NEAR(consistency.pose_inside, 1.0, 1e-12);
}

}  // namespace
}  // namespace grid_path_planner::trials
