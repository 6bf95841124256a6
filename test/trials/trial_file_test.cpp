#include <gtest/gtest.h>

#include <filesystem>

#include "support/error_text.h"
#include "support/temporary_folder.h"
#include "trials/trial_study.h"

namespace grid_path_planner::trials {
namespace {

using test::contains, test::errorText;

TEST(TrialFile, TheTrialHasTheErrorsOfTheIssueAndThePublishedTable) {
  const TrialStudy study = readTrialFile("config/localization_trial.yaml");
  EXPECT_EQ(study.drive.seconds, 300.0);
  ASSERT_EQ(study.sets.size(), 3u);
  EXPECT_EQ(study.sets[0].name, "nominal");
  EXPECT_EQ(study.sets[0].sensors.dvl.misalignment, 0.0);
  const ErrorSet& field = study.sets[1];
  EXPECT_EQ(field.name, "field");
  EXPECT_NEAR(field.sensors.dvl.misalignment * 180.0 / M_PI, 2.0, 1e-4);
  EXPECT_NEAR(field.sensors.imu.heading_error * 180.0 / M_PI, 8.0, 1e-4);
  EXPECT_EQ(field.camera_clock, 0.05);
  EXPECT_TRUE(field.sensors.usbl.enabled);
  EXPECT_EQ(study.published.at("L5").smoothness, 0.94);
  EXPECT_EQ(study.published_figures.at("panel metres"), 0.118);
  EXPECT_EQ(readTrialFile("config/localization_smoke.yaml").seeds, 2);
}

class BadTrial : public testing::Test {
 protected:
  std::string refusal(const std::string& more,
                      const std::string& sets = "error_sets: [{name: nominal}]") const {
    const std::string file = folder.write(
        "trial.yaml",
        "title: Bad\nworld: w.sdf\nlayout: l.yaml\npanel: [0, 0, 0, 0]\n" + sets + "\n" + more);
    return errorText([&] { readTrialFile(file); });
  }
  const test::TemporaryFolder folder;
};

TEST_F(BadTrial, MistakesAreToldWithFileAndLine) {
  EXPECT_EQ(refusal(""), "");
  EXPECT_TRUE(contains(refusal("sedes: 3"), "trial.yaml:6"));
  EXPECT_TRUE(contains(refusal("sedes: 3"), "sedes"));
  EXPECT_TRUE(contains(refusal("seeds: 1"), "trial.yaml:6"));
  EXPECT_TRUE(contains(refusal("filter: {gait: none}"), "filter has no option 'gait'"));
  EXPECT_TRUE(contains(refusal("filter: {gate: any}"), "chi_squared, either"));
  EXPECT_TRUE(contains(refusal("outliers: 2"), "outliers must be from 0 to 1"));
  EXPECT_TRUE(contains(refusal("outliers: .nan"), "trial.yaml:6"));
  EXPECT_TRUE(contains(refusal("fault: [50, 20]"), "the earlier one first"));
  EXPECT_TRUE(contains(refusal("drive: {seconds: 60}"), "fault must end within the drive"));
  EXPECT_TRUE(contains(refusal("drive: {range: [3, 2]}"), "the nearest and the farthest"));
  EXPECT_TRUE(contains(refusal("default_covariance: [0, 1]"), "above 0"));
  EXPECT_TRUE(contains(refusal("", "error_sets: [{name: a}, {name: a}]"), "twice"));
  EXPECT_TRUE(contains(refusal("", "error_sets: [{name: a, sensors: {dvl_scale: 1}}]"),
                       "sensors has no option 'dvl_scale'"));
  EXPECT_TRUE(contains(refusal("", "error_sets: []"), "trial.yaml:5"));
  EXPECT_TRUE(contains(errorText([&] { readTrialFile("gone.yaml"); }), "gone.yaml"));
}

// At the end of a fault that no image came after, every row was 0.000 m off.
TEST_F(BadTrial, AFaultThatEndsAfterTheLastImageIsRefused) {
  const std::string drive = "drive: {seconds: 19}\nsettle: 2\ncamera: {rate: 0.5}\n";
  EXPECT_EQ(refusal(drive + "fault: [10, 18]"), "");
  EXPECT_TRUE(
      contains(refusal(drive + "fault: [10, 18.5]"), "trial.yaml:9: fault must end within"));
  EXPECT_TRUE(contains(refusal(drive + "fault: [10, 18.5]"), "'nominal' has at 18 s"));
  const std::string late = "error_sets: [{name: nominal}, {name: late, camera_clock: 1.5}]";
  EXPECT_TRUE(contains(refusal(drive + "fault: [10, 18]", late), "'late' has at 17.5 s"))
      << "that of 18 s comes after the drive";
}

// Of two sets that differ in a space the trajectories were those of the last one.
TEST_F(BadTrial, SetsWhoseTrajectoriesHaveOneNameAreRefused) {
  EXPECT_TRUE(contains(refusal("", "error_sets: [{name: a b}, {name: a_b}]"),
                       "trial.yaml:5: 'a_b' has a file of another one: a_b_truth"))
      << refusal("", "error_sets: [{name: a b}, {name: a_b}]");
  EXPECT_TRUE(contains(refusal("", "error_sets: [{name: a}, {name: a_L5}]"), "a_L5_joint"))
      << "L5 joint of the first, joint of the second";
  EXPECT_EQ(refusal("", "error_sets: [{name: a}, {name: b}]"), "");
}

}  // namespace
}  // namespace grid_path_planner::trials
