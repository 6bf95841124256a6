// A trial on a bag: what its topics allow is played, what they do not allow is named, and a bad bag is one sentence.
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <regex>
#include <set>
#include <sstream>

#include "command_line/run_command.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::command_line {
namespace {

using test::contains, test::contentOf;
using Topics = std::set<std::string>;

const Topics kAll = {"imu/data",    "dvl/twist",    "depth", "usbl/pose",
                     "marker_pose", "ground_truth", "/tf"};
constexpr double kSpeed = 0.2;  // m/s
constexpr double kDeviation = 0.01;

// A vehicle that goes along x for 20 s, level, and what its sensors say of that. Markers see it `marker_shift` metres
// too far along.
class Dive {
 public:
  Dive(const std::string& file, Topics topics, double marker_shift = 0.0)
      : topics_(std::move(topics)), bag_(file, rosbag::bagmode::Write) {
    for (int tick = 0; tick <= 1000; ++tick) {
      now_ = ros::Time(1000.0 + 0.02 * tick);
      if (tick % 10 == 0) write("/tf", frames());
      write("imu/data", imu());
      if (tick % 7 == 0) write("dvl/twist", dvl());
      if (tick % 5 == 0) write("depth", pose(kDeviation));
      if (tick % 50 == 0) write("usbl/pose", pose(kDeviation));
      if (tick % 10 == 0) write("marker_pose", pose(kDeviation, marker_shift));
      if (tick % 2 == 0) write("ground_truth", truth());
    }
  }

 private:
  template <class Message>
  void write(const std::string& topic, const Message& message) {
    if (topics_.count(topic) != 0) bag_.write(topic, now_, message);
  }

  template <class Message>
  Message stamped(const std::string& frame) const {
    Message message;
    message.header.stamp = now_;
    message.header.frame_id = frame;
    return message;
  }

  double noise() { return kDeviation * normal_(random_); }

  tf2_msgs::TFMessage frames() const {
    tf2_msgs::TFMessage message;
    for (const char* frame : {"imu_link", "dvl_link", "usbl_link", "pressure_link"}) {
      auto transform = stamped<geometry_msgs::TransformStamped>("base_link");
      transform.child_frame_id = frame;
      transform.transform.rotation.w = 1.0;
      message.transforms.push_back(transform);
    }
    return message;
  }

  sensor_msgs::Imu imu() const {
    auto message = stamped<sensor_msgs::Imu>("imu_link");
    message.orientation.w = 1.0;
    message.linear_acceleration.z = 9.80665;
    return message;
  }

  geometry_msgs::TwistWithCovarianceStamped dvl() {
    auto message = stamped<geometry_msgs::TwistWithCovarianceStamped>("dvl_link");
    message.twist.twist.linear.x = kSpeed + noise();
    message.twist.twist.linear.y = noise();
    message.twist.twist.linear.z = noise();
    for (std::size_t i = 0; i < 36; i += 7) message.twist.covariance[i] = kDeviation * kDeviation;
    return message;
  }

  geometry_msgs::PoseWithCovarianceStamped pose(double deviation, double shift = 0.0) {
    auto message = stamped<geometry_msgs::PoseWithCovarianceStamped>("map");
    message.pose.pose.position.x = kSpeed * (now_.toSec() - 1000.0) + noise() + shift;
    message.pose.pose.position.y = noise();
    message.pose.pose.position.z = noise();
    message.pose.pose.orientation.w = 1.0;
    for (std::size_t i = 0; i < 36; i += 7) message.pose.covariance[i] = deviation * deviation;
    return message;
  }

  nav_msgs::Odometry truth() const {
    auto message = stamped<nav_msgs::Odometry>("map");
    message.child_frame_id = "base_link";
    message.pose.pose.position.x = kSpeed * (now_.toSec() - 1000.0);
    message.pose.pose.orientation.w = 1.0;
    return message;
  }

  Topics topics_;
  rosbag::Bag bag_;
  ros::Time now_;
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

class BagTrial : public testing::Test {
 protected:
  Outcome run(const Topics& topics, const std::string& more = "settle: 2\n") const {
    Dive(folder.path("dive.bag"), topics);
    return runOnBag(more);
  }
  Outcome runOnBag(const std::string& more) const {
    const std::string trial = folder.write("trial.yaml", "title: Dive\nbag: dive.bag\n" + more);
    return runCommand(runLocalization, {"localization", trial, "--out", folder.path("out")});
  }
  // A row of a table, split at commas; none: empty.
  std::vector<std::string> rowOf(const std::string& table, const std::string& name) const {
    std::istringstream lines(contentOf(folder.path("out/" + table + ".csv")));
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind(name + ",", 0) != 0) continue;
      std::vector<std::string> cells;
      std::istringstream rest(std::regex_replace(line, std::regex("\"[^\"]*\""), "text"));
      for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
      return cells;
    }
    return {};
  }
  double figure(const std::string& row, std::size_t column) const {
    return std::stod(rowOf("figures", row).at(column));
  }
  const test::TemporaryFolder folder;
};

TEST_F(BagTrial, AllTopicsGiveAllRowsAndTheyAreNearTheTruth) {
  const Outcome outcome = run(kAll);
  ASSERT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.code, 0);
  for (const char* row : {"L1", "L1 joint", "L2", "L3", "L4", "L5", "L5 both", "L5 joint",
                          "L5 USBL", "L5 heading", "joint", "USBL", "all"}) {
    SCOPED_TRACE(row);
    ASSERT_EQ(rowOf("figures", row).size(), 12u);
    EXPECT_LT(figure(row, 10), 0.15);
  }
  EXPECT_LT(figure("all", 10), 0.01);
  EXPECT_GT(figure("all", 5), figure("all", 8));  // the markers' noise is in the first
  const std::string truth = contentOf(folder.path("out/tum/truth.txt"));
  EXPECT_EQ(truth.substr(0, 11), "1002.000000");
  EXPECT_FALSE(contentOf(folder.path("out/tum/L5_joint.txt")).empty());
  EXPECT_TRUE(contains(contentOf(folder.path("out/report.html")), "It allows every row."));
}

TEST_F(BagTrial, WhatTheTopicsDoNotAllowIsNamedWithItsReason) {
  ASSERT_EQ(run({"imu/data", "dvl/twist", "marker_pose", "/tf"}).error, "");
  EXPECT_EQ(rowOf("figures", "L5").size(), 12u);
  EXPECT_TRUE(rowOf("figures", "L5 USBL").empty());
  const std::string page = contentOf(folder.path("out/report.html"));
  EXPECT_TRUE(contains(page, "L5 USBL: usbl/pose: the bag has no such topic."));
  EXPECT_FALSE(std::filesystem::exists(folder.path("out/tracks.csv")));  // there is no truth
}

// Without markers and truth the pose begins at an acoustic fix, with the heading of the IMU.
TEST_F(BagTrial, AcousticFixesAloneAllowTheirRow) {
  ASSERT_EQ(run({"imu/data", "dvl/twist", "depth", "usbl/pose", "/tf"}).error, "");
  EXPECT_EQ(rowOf("figures", "USBL").size(), 12u);
  EXPECT_TRUE(contains(contentOf(folder.path("out/report.html")),
                       "L2: nothing says where it begins: no marker pose, no truth."));
}

// Stamps alone told one recording from another: a bag with the markers' layout corrected got the rows of the wrong one.
TEST_F(BagTrial, ACorrectedBagDoesNotGoOnWithTheRowsOfTheOneBefore) {
  const Topics some = {"imu/data", "dvl/twist", "marker_pose", "/tf"};
  ASSERT_EQ(run(some).error, "");
  const std::string rows = contentOf(folder.path("out/runs.jsonl"));
  EXPECT_EQ(run(some).error, "") << "the same bag, written again, goes on";
  Dive(folder.path("dive.bag"), some, 1.0);
  EXPECT_TRUE(contains(runOnBag("settle: 2\n").error, "holds the runs of another trials"));
  EXPECT_EQ(contentOf(folder.path("out/runs.jsonl")), rows);
}

TEST_F(BagTrial, PlacesOfSensorsMayBeToldByTheTrial) {
  const std::string frames =
      "frames: {imu_link: [0, 0, 0, 0, 0, 0], dvl_link: [0, 0, 0, 0, 0, 0]}\nsettle: 2\n";
  ASSERT_EQ(run({"imu/data", "dvl/twist", "marker_pose", "ground_truth"}, frames).error, "");
  EXPECT_LT(figure("L5 joint", 10), 0.02);
}

TEST_F(BagTrial, BadBagsEndInOneSentence) {
  const Topics some = {"imu/data", "marker_pose", "/tf"};
  EXPECT_TRUE(contains(run({}).error, "dive.bag: allows no row"));
  EXPECT_TRUE(contains(run({"imu/data", "marker_pose"}).error, "are refused"));  // no transforms
  EXPECT_TRUE(
      contains(run(some, "topics: {dvl: imu/data}\n").error,
               "imu/data is sensor_msgs/Imu, not geometry_msgs/TwistWithCovarianceStamped"));
  EXPECT_TRUE(contains(run(some, "topics: {imu: imu}\n").error, "sensor_msgs/Imu is on imu/data"));
  const std::string whole = contentOf(folder.path("dive.bag"));
  folder.write("dive.bag", whole.substr(0, whole.size() / 2));
  EXPECT_TRUE(contains(runOnBag("").error, "dive.bag: is damaged or cut short"));
  folder.write("dive.bag", "no bag");
  EXPECT_TRUE(contains(runOnBag("").error, "dive.bag: is not a bag"));
  std::filesystem::remove(folder.path("dive.bag"));
  EXPECT_TRUE(contains(runOnBag("").error, "dive.bag"));
}

TEST_F(BagTrial, ABagThatGoesBackInTimeIsRefused) {
  Dive(folder.path("dive.bag"), kAll);
  {
    rosbag::Bag bag(folder.path("dive.bag"), rosbag::bagmode::Append);
    sensor_msgs::Imu message;
    bag.write("imu/data", ros::Time(900.0), message);
  }
  EXPECT_TRUE(contains(runOnBag("").error, "goes back in time"));
}

TEST_F(BagTrial, MistakesInTheFileAreToldWithTheirLine) {
  const auto refusal = [&](const std::string& more) { return runOnBag(more).error; };
  EXPECT_TRUE(contains(refusal("world: a.sdf\n"), "trial.yaml:3"));
  EXPECT_TRUE(contains(refusal("topics: {imo: a}\n"), "imo"));
  EXPECT_TRUE(contains(refusal("settle: 2\nlocalizer: {gait: none}\n"), "trial.yaml:4"));
  EXPECT_TRUE(contains(refusal("localizer: {gate: any}\n"), "trial.yaml:3"));
  EXPECT_TRUE(contains(refusal("localizer: {odom_frame: map}\n"), "must be three"));
  EXPECT_TRUE(contains(refusal("frames: {imu_link: [1, 2]}\n"), "imu_link must have 6 numbers"));
  EXPECT_TRUE(contains(refusal("frames: 3\n"), "frames must be a mapping"));
}

}  // namespace
}  // namespace grid_path_planner::command_line
