// The node local_planner flies the simulator's vehicle above the floor of test/data/pool.sdf.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/UInt32.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "grid_path_planner/AvoidanceStatus.h"
#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/avoidance/flight_log.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "support/temporary_folder.h"

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

// m/s, of the fastest axis.
double speedOf(const TwistStamped& command) {
  const auto& v = command.twist.linear;
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// The clouds pass through the test, which can cut the camera.
class LocalPlannerTest : public testing::Test {
 protected:
  LocalPlannerTest() {
    simulator_ = std::make_unique<Process>("simulator", kWorld);
    pilot_ = std::make_unique<Process>(
        "local_planner",
        std::vector<std::string>{"camera_info:=depth_camera/camera_info", "_no_return_clears:=10",
                                 "_z_min:=-1.4", "_z_max:=2", "--log", log_});
  }

  void relay(const PointCloud2::ConstPtr& cloud) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (cut_) return;
    last_cloud_ = std::max(last_cloud_, cloud->header.stamp);
    clouds_.publish(cloud);
  }

  // Nothing is passed on after this. Returns the stamp of the newest cloud that was.
  ros::Time cutCamera() {
    const std::lock_guard<std::mutex> lock(mutex_);
    cut_ = true;
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

  const test::TemporaryFolder folder_;
  const std::string log_ = folder_.path("log.flight");
  ros::NodeHandle nh_;
  Latest<AvoidanceStatus> statuses_{nh_, "avoidance_status"};
  Latest<TwistStamped> commands_{nh_, "setpoint_velocity"};
  Latest<Odometry> truth_{nh_, "ground_truth"};
  Latest<std_msgs::UInt32> contacts_{nh_, "contacts"};
  ros::Publisher goals_ = nh_.advertise<geometry_msgs::PoseStamped>("goal", 1, true);
  ros::Publisher clouds_ = nh_.advertise<PointCloud2>("points", 10);
  std::mutex mutex_;  // the clouds come in another thread
  bool cut_ = false;
  ros::Time last_cloud_;
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
  EXPECT_TRUE(test::waitFor([&] {
    const auto place = truth_.all().back().pose.pose.position;
    return Eigen::Vector3d(place.x, place.y, place.z).norm() < 0.6;
  })) << "home_radius and braking";
  EXPECT_TRUE(test::waitFor([&] { return !moves(commands_.all().back()); })) << "a zero at the end";
  EXPECT_EQ(contacts_.waitForMoreThan(0)->data, 0u);
}

// A goal of the action, with all that is published meanwhile; afterwards the log repeats the flight.
TEST_F(LocalPlannerTest, FliesAGoalOfTheActionAndKeepsALog) {
  Latest<NavigatePathActionResult> results(nh_, "navigate_path/result");
  Latest<NavigatePathActionFeedback> feedback(nh_, "navigate_path/feedback");
  Latest<trajectory_msgs::MultiDOFJointTrajectory> trajectories(nh_, "setpoint_trajectory");
  Latest<sensor_msgs::Image> pictures(nh_, "histogram_image");
  Latest<visualization_msgs::MarkerArray> markers(nh_, "avoidance_markers");
  ros::Publisher goals = nh_.advertise<NavigatePathActionGoal>("navigate_path/goal", 1, true);
  ASSERT_TRUE(truth_.waitForMoreThan(0));
  ASSERT_TRUE(statuses_.waitFor(0, [](const AvoidanceStatus&) { return true; }));
  NavigatePathActionGoal goal;
  goal.goal_id.id = "there";
  goal.goal.path.header.frame_id = "map";
  goal.goal.path.poses.resize(1);
  goal.goal.path.poses[0].pose.position.x = -3.0;
  goal.goal.path.poses[0].pose.orientation.w = 1.0;
  goals.publish(goal);
  ASSERT_TRUE(test::waitFor([&] { return results.count() > 0; }, kFlight)) << said();
  EXPECT_EQ(results.all().back().result.status, "ARRIVED") << said();
  EXPECT_LE(results.all().back().result.position_error_m, 0.6);
  EXPECT_GT(feedback.count(), 0u);
  ASSERT_GT(pictures.count(), 0u);
  EXPECT_EQ(pictures.all().back().data.size(),
            pictures.all().back().step * pictures.all().back().height);
  ASSERT_GT(markers.count(), 0u);
  EXPECT_EQ(markers.all().back().markers.size(), 4u);
  const auto all = trajectories.all();
  ASSERT_FALSE(all.empty());
  bool leads = false;
  for (const auto& trajectory : all) {
    EXPECT_EQ(trajectory.header.frame_id, "map");
    ASSERT_FALSE(trajectory.points.empty());
    if (trajectory.points.size() < 2) continue;
    leads = true;
    const auto& end = trajectory.points.back().velocities[0].linear;
    EXPECT_EQ(Eigen::Vector3d(end.x, end.y, end.z).norm(), 0.0) << "it stands at the end";
    EXPECT_LT(trajectory.points[0].time_from_start, trajectory.points[1].time_from_start);
  }
  EXPECT_TRUE(leads);
  pilot_.reset();
  const avoidance::ReplayResult again = avoidance::replayFlight(log_);
  EXPECT_GT(again.updates, 20u);
  EXPECT_EQ(again.differing, 0u) << again.first_difference;
}

TEST_F(LocalPlannerTest, RefusesAGoalOfTheActionThatGivesNothing) {
  Latest<NavigatePathActionResult> results(nh_, "navigate_path/result");
  ros::Publisher goals = nh_.advertise<NavigatePathActionGoal>("navigate_path/goal", 1, true);
  ASSERT_TRUE(test::waitFor([&] { return results.connected(); }, kFlight));
  NavigatePathActionGoal goal;
  goal.goal_id.id = "nothing";
  goals.publish(goal);
  ASSERT_TRUE(test::waitFor([&] { return results.count() > 0; }, kFlight));
  EXPECT_EQ(results.all().back().result.status, "INVALID_REQUEST");
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
  const ros::Time limit = cutCamera() + ros::Duration(0.5);
  ASSERT_TRUE(statuses_.waitFor(0, [](const AvoidanceStatus& status) {
    return status.status == "NO_CLOUD";
  })) << said();
  const std::size_t seen = commands_.count();
  ASSERT_TRUE(commands_.waitForMoreThan(seen + 5)) << "it goes on commanding zeros";
  const std::vector<TwistStamped> all = commands_.all();
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), moves)) << "it flew";
  // A zero at the limit or, where nothing is planned in time, braking by max_acceleration (2 m/s^2) since the cloud is
  // too old, 0.1 s before, but for a period of control_rate.
  double fastest = 0.0;
  for (const TwistStamped& command : all) {
    if (command.header.stamp <= limit) fastest = std::max(fastest, speedOf(command));
    if (command.header.stamp > limit) {
      const double braked = 2.0 * ((command.header.stamp - limit).toSec() + 0.1 - 0.05);
      EXPECT_LE(speedOf(command), std::max(0.0, fastest - braked) + 1e-6) << command;
    }
  }
  EXPECT_TRUE(test::waitFor([&] { return !moves(commands_.all().back()); }));
  EXPECT_TRUE(truth_.waitFor(truth_.count(), [](const Odometry& odometry) {
    const auto& v = odometry.twist.twist.linear;
    return Eigen::Vector3d(v.x, v.y, v.z).norm() < 1e-3;
  })) << "and the vehicle stands";
  EXPECT_LT(truth_.all().back().pose.pose.position.x, -1.0) << "before the goal";
}

}  // namespace
}  // namespace grid_path_planner::nodes
