// The node local_planner flies the simulator's vehicle above the floor of test/data/pool.sdf.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/UInt32.h>

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "grid_path_planner/AvoidanceStatus.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"

namespace grid_path_planner::nodes {
namespace {

using geometry_msgs::TwistStamped;
using nav_msgs::Odometry;
using sensor_msgs::PointCloud2;
using test::Latest;
using test::Process;

constexpr std::chrono::seconds kFlight(60 * test::kSlowdown);

const std::vector<std::string> kWorld = {"--world=" GPP_TEST_DATA "/pool.sdf",
                                         "_initial_x:=-6",
                                         "_max_surge_speed:=2",
                                         "_max_sway_speed:=2",
                                         "_max_heave_speed:=1",
                                         "_max_yaw_rate:=0.5236",
                                         "_max_acceleration:=2",
                                         "_camera_width:=80",
                                         "_camera_height:=60",
                                         "_camera_x:=0",
                                         "_camera_z:=0",
                                         "_camera_pitch:=0"};

bool moves(const TwistStamped& command) {
  const auto& v = command.twist.linear;
  return v.x != 0.0 || v.y != 0.0 || v.z != 0.0 || command.twist.angular.z != 0.0;
}

// The clouds pass through the test, which can cut the camera.
class LocalPlannerTest : public testing::Test {
 protected:
  LocalPlannerTest() {
    simulator_ = std::make_unique<Process>("simulator", kWorld);
    pilot_ = std::make_unique<Process>(
        "local_planner",
        std::vector<std::string>{"camera_info:=depth_camera/camera_info", "_no_return_clears:=10",
                                 "_z_min:=-1.4", "_z_max:=2"});
  }

  void relay(const PointCloud2::ConstPtr& cloud) {
    if (cut_) return;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      last_cloud_ = std::max(last_cloud_, cloud->header.stamp);
    }
    clouds_.publish(cloud);
  }

  ros::Time lastCloud() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return last_cloud_;
  }

  void sendGoal(double x) {
    ASSERT_TRUE(test::waitFor([&] { return truth_.count() > 0; }, kFlight));
    ASSERT_TRUE(statuses_.waitFor(0, [](const AvoidanceStatus&) { return true; }));
    ASSERT_TRUE(test::waitFor([&] { return goals_.getNumSubscribers() > 0; }));
    geometry_msgs::PoseStamped goal;
    goal.header.frame_id = "map";
    goal.pose.position.x = x;
    goal.pose.orientation.w = 1.0;
    goals_.publish(goal);
  }

  // All that was said, for messages of failed tests.
  std::string said() const {
    std::string text;
    for (const AvoidanceStatus& status : statuses_.all())
      text += status.status + ": " + status.sentence + "\n";
    return text;
  }

  ros::NodeHandle nh_;
  Latest<AvoidanceStatus> statuses_{nh_, "avoidance_status"};
  Latest<TwistStamped> commands_{nh_, "setpoint_velocity"};
  Latest<Odometry> truth_{nh_, "ground_truth"};
  Latest<std_msgs::UInt32> contacts_{nh_, "contacts"};
  ros::Publisher goals_ = nh_.advertise<geometry_msgs::PoseStamped>("goal", 1, true);
  ros::Publisher clouds_ = nh_.advertise<PointCloud2>("points", 10);
  std::atomic<bool> cut_{false};
  std::mutex mutex_;
  ros::Time last_cloud_;  // under the mutex
  ros::Subscriber relay_ = nh_.subscribe("depth_camera/points", 10, &LocalPlannerTest::relay, this);
  std::unique_ptr<Process> simulator_, pilot_;
};

TEST_F(LocalPlannerTest, FliesToAGoalInTheOpen) {
  ASSERT_NO_FATAL_FAILURE(sendGoal(0.0));
  EXPECT_TRUE(test::waitFor(
      [&] {
        const auto all = statuses_.all();
        return !all.empty() && all.back().status == "ARRIVED";
      },
      kFlight))
      << said();
  const auto place = truth_.all().back().pose.pose.position;
  EXPECT_LE(Eigen::Vector3d(place.x, place.y, place.z).norm(), 0.6) << "home_radius and braking";
  EXPECT_FALSE(moves(commands_.all().back())) << "a zero at the end";
  EXPECT_EQ(contacts_.waitForMoreThan(0)->data, 0u);
}

// Judged by the stamps of commands, which say when the node decided: true however busy the machine is.
TEST_F(LocalPlannerTest, StandsHalfASecondAfterTheCameraIsCut) {
  ASSERT_NO_FATAL_FAILURE(sendGoal(0.0));
  ASSERT_TRUE(test::waitFor(
      [&] {
        const auto all = truth_.all();
        return !all.empty() && all.back().pose.pose.position.x > -4.5;
      },
      kFlight))
      << said();
  cut_ = true;
  ASSERT_TRUE(statuses_.waitFor(0, [](const AvoidanceStatus& status) {
    return status.status == "NO_CLOUD";
  })) << said();
  const std::size_t seen = commands_.count();
  ASSERT_TRUE(commands_.waitForMoreThan(seen + 5)) << "it goes on commanding zeros";
  const ros::Time limit = lastCloud() + ros::Duration(0.5);
  const std::vector<TwistStamped> all = commands_.all();
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), moves)) << "it flew";
  for (const TwistStamped& command : all)
    if (command.header.stamp > limit) EXPECT_FALSE(moves(command)) << command;
  EXPECT_TRUE(truth_.waitFor(truth_.count(), [](const Odometry& odometry) {
    const auto& v = odometry.twist.twist.linear;
    return Eigen::Vector3d(v.x, v.y, v.z).norm() < 1e-3;
  })) << "and the vehicle stands";
  EXPECT_LT(truth_.all().back().pose.pose.position.x, -1.0) << "before the goal";
}

}  // namespace
}  // namespace grid_path_planner::nodes
