// A vehicle_localizer that was killed and starts again, on a vehicle whose IMU's heading drifts.
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <std_msgs/String.h>
#include <std_srvs/Trigger.h>

#include <filesystem>

#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "ros/support/sensor_stream.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::contains;
using test::Latest;
using test::LiveStream;
using test::Process;
using test::SensorStream;
using test::waitFor;

constexpr double kDrift = 0.6;  // rad

class LocalizerRestart : public testing::Test {
 protected:
  LocalizerRestart() { ros::param::del("/vehicle_localizer"); }

  void start() {
    node_ = std::make_unique<Process>("vehicle_localizer",
                                      std::vector<std::string>{"--save-folder", save_folder_});
  }
  bool isOk() const {
    const auto all = statuses_->all();
    return !all.empty() && contains(all.back().data, "OK:");
  }
  // Whether the heading is kept that the IMU's drift is told by.
  bool isKept() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path("."))) {
      std::ifstream file(entry.path());
      std::string word;
      double offset = 0.0;
      while (file >> word)
        if (word == "offset" && file >> offset && std::abs(offset - kDrift) < 0.1) return true;
    }
    return false;
  }
  // It is OK before the IMU drifts, by which its heading is known.
  void startAndDrift() {
    start();
    ASSERT_TRUE(waitFor([this] { return isOk(); }));
    stream_.drift = kDrift;
    ASSERT_TRUE(waitFor([this] { return isKept(); }));
  }
  // The error of the yaw with which its pose begins anew.
  double errorAfterKill() {
    node_->signal(SIGKILL);
    EXPECT_TRUE(node_->waitForExit());
    statuses_ = std::make_unique<Latest<std_msgs::String>>(nh_, "localization_status");
    filtered_ = std::make_unique<Latest<nav_msgs::Odometry>>(nh_, "odometry/filtered");
    start();
    EXPECT_TRUE(waitFor([this] { return isOk() && filtered_->count() > 0; }));
    const nav_msgs::Odometry first = filtered_->all().front();
    const auto& o = first.pose.pose.orientation;
    const Eigen::Quaterniond truth =
        stream_.trajectory.stateAt(live_.secondsAt(first.header.stamp)).attitude;
    return std::abs(std::remainder(
        localization::yawOf({o.w, o.x, o.y, o.z}) - localization::yawOf(truth), 2.0 * M_PI));
  }

  const test::TemporaryFolder folder_;
  std::string save_folder_ = folder_.path(".");
  ros::NodeHandle nh_;
  std::unique_ptr<Latest<std_msgs::String>> statuses_ =
      std::make_unique<Latest<std_msgs::String>>(nh_, "localization_status");
  std::unique_ptr<Latest<nav_msgs::Odometry>> filtered_;
  SensorStream stream_{nh_};
  LiveStream live_{stream_};
  std::unique_ptr<Process> node_;
};

// It said OK with the heading of the IMU, and the vehicle drove into the panel.
TEST_F(LocalizerRestart, BeginsWithTheHeadingThatItKnew) {
  startAndDrift();
  EXPECT_LT(errorAfterKill(), 0.2);
  EXPECT_TRUE(node_->says("Begins with the heading that was kept"));
}

TEST_F(LocalizerRestart, ResetForgetsTheHeading) {
  startAndDrift();
  std_srvs::Trigger call;
  ASSERT_TRUE(ros::service::call("/vehicle_localizer/reset", call));
  node_->signal(SIGKILL);
  ASSERT_TRUE(node_->waitForExit());
  EXPECT_FALSE(isKept());
}

TEST_F(LocalizerRestart, AFolderThatCannotBeWrittenIsToldAndTheNodeGoesOn) {
  save_folder_ = "/proc/self/none";
  start();
  EXPECT_TRUE(node_->says("The heading cannot be kept for a node that starts again: "));
  EXPECT_TRUE(waitFor([this] { return isOk(); }));
}

}  // namespace
}  // namespace grid_path_planner::nodes
