// When local_planner stands although something is flown, and what it does not begin to fly.
//
// What was seen before: a path that path_planner had latched was flown by a local_planner that was started,
// or respawned, long after; with /clock standing still every cloud stayed new and the vehicle drove on; one
// cloud with stamp 0 after the start blinded it until it was restarted; the joystick gave the vehicle
// back to the flight by itself; ~cancel without a flight was a success.
#include <actionlib_msgs/GoalID.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include "grid_path_planner/NavigatePathActionGoal.h"
#include "grid_path_planner/NavigatePathActionResult.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/support/flight_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::Latest;
using test::stands;

class HoldsTest : public test::FlightTest {
 protected:
  // From now on a status comes with this sentence, and after it no command but zeros.
  ::testing::AssertionResult standsSaying(const std::string& words) {
    if (!says(words)) return ::testing::AssertionFailure() << said();
    const std::size_t from = commands_.count();
    if (!commands_.waitForMoreThan(from + 10))
      return ::testing::AssertionFailure() << "no commands come";
    const auto all = commands_.all();
    const bool zeros = std::all_of(all.begin() + static_cast<std::ptrdiff_t>(from) + 1, all.end(),
                                   stands);  // one may have been sent before
    return zeros ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << "it drives";
  }
};

TEST_F(HoldsTest, StopStopsAndLetsGo) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  send(stops_, true);
  EXPECT_TRUE(standsSaying("stopped by the topic /stop"));
  send(stops_, false);
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, AJoystickPausesUntilResume) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  send(manuals_, true);
  ASSERT_TRUE(says("the joystick commands")) << said();
  const std::size_t before = commands_.count();
  for (int i = 0; i < 10; ++i) {
    send(manuals_, true);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_LE(commands_.count(), before + 1) << "the joystick's commands are in force";
  EXPECT_FALSE(call("resume").success);
  send(manuals_, false);
  EXPECT_TRUE(standsSaying("paused until ~resume"));
  EXPECT_TRUE(call("resume").success);
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, ServicesSayWhetherTheyDidAnything) {
  ASSERT_NO_FATAL_FAILURE(start());
  for (const char* service : {"resume", "cancel"}) EXPECT_FALSE(call(service).success) << service;
  EXPECT_TRUE(call("pause").success) << "of the next flight";
  EXPECT_TRUE(call("cancel").success);
  sendGoal(sky_.now());
  ASSERT_TRUE(flies()) << said();
  EXPECT_TRUE(call("pause").success);
  EXPECT_TRUE(standsSaying("paused until ~resume"));
  EXPECT_TRUE(call("resume").success);
  EXPECT_TRUE(flies()) << said();
  EXPECT_TRUE(call("cancel").success);
  EXPECT_TRUE(says("CANCELLED")) << said();
  EXPECT_TRUE(endsInAZero());
  EXPECT_FALSE(call("cancel").success);
}

// path_planner keeps a goal and plans anew when the map changes: a flight that had been cancelled began
// again by itself.
TEST_F(HoldsTest, APathForAGoalThatWasCancelledIsNotFlown) {
  ASSERT_NO_FATAL_FAILURE(start());
  const ros::Time goal = sky_.now();
  sendPath(goal, {0.0, 40.0});
  ASSERT_TRUE(flies()) << said();
  EXPECT_TRUE(call("cancel").success);
  ASSERT_TRUE(says("CANCELLED")) << said();
  sendPath(goal, {0.0, 40.0});
  EXPECT_TRUE(pilot_->says("A path is not flown: its goal was reached or cancelled"));
  EXPECT_TRUE(endsInAZero());
  sendPath(sky_.now(), {0.0, 40.0});
  EXPECT_TRUE(flies()) << said();
}

// path_planner finds no path, and then one again: the vehicle that somebody had paused flew off.
TEST_F(HoldsTest, APauseOutlivesAnEmptyPathAndHoldsForTheNext) {
  ASSERT_NO_FATAL_FAILURE(start());
  const ros::Time goal = sky_.now();
  sendPath(goal, {0.0, 40.0});
  ASSERT_TRUE(flies()) << said();
  EXPECT_TRUE(call("pause").success);
  sendPath(sky_.now(), {});
  ASSERT_TRUE(says("CANCELLED: cancelled: the path is empty")) << said();
  sendPath(goal, {0.0, 40.0});
  EXPECT_TRUE(standsSaying("paused until ~resume"));
  EXPECT_TRUE(call("resume").success);
  EXPECT_TRUE(flies()) << said();
}

class ActionHoldsTest : public HoldsTest {
 protected:
  void startWithAction(const std::vector<std::string>& more = {}) {
    ASSERT_NO_FATAL_FAILURE(start(more));
    ASSERT_TRUE(test::waitFor(
        [&] { return goals_of_action_.getNumSubscribers() > 0 && results_.connected(); }));
    NavigatePathActionGoal goal;
    goal.goal_id.id = "far";
    goal.goal.path.header.frame_id = "map";
    goal.goal.path.poses.resize(1);
    goal.goal.path.poses[0].pose.position.x = 40.0;
    goal.goal.path.poses[0].pose.orientation.w = 1.0;
    goals_of_action_.publish(goal);
    ASSERT_TRUE(flies()) << said();
  }
  void replaceBy(const std::string& file) {
    NavigatePathActionGoal goal;
    goal.goal_id.id = "other";
    goal.goal.filename = file;
    goals_of_action_.publish(goal);
    ASSERT_TRUE(results_.waitForMoreThan(0));
    EXPECT_EQ(results_.all()[0].result.status, "CANCELLED");
  }

  Latest<NavigatePathActionResult> results_{nh_, "navigate_path/result"};
  ros::Publisher goals_of_action_ = nh_.advertise<NavigatePathActionGoal>("navigate_path/goal", 1);
};

// The flight went on for a goal that had been told its end, and no cancel of the action reached it any more.
TEST_F(ActionHoldsTest, AGoalThatIsRefusedEndsTheFlightThatItReplaced) {
  ASSERT_NO_FATAL_FAILURE(startWithAction());
  ASSERT_NO_FATAL_FAILURE(replaceBy(""));
  const auto refused = results_.waitForMoreThan(1);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->result.status, "INVALID_REQUEST");
  EXPECT_TRUE(endsInAZero());
}

// Whoever has paused the vehicle does not see it fly off because another goal comes.
TEST_F(ActionHoldsTest, AFileThatReplacesAPausedGoalIsFlownWhenItIsResumed) {
  const test::TemporaryFolder folder;
  path::Path route{"map", {}};
  for (int i = 0; i < 5000; ++i) route.poses.push_back({{40.0 + 0.001 * i, 0.0, 0.0}, 0.0});
  path::writeWaypointFile(folder.path("route.yaml"), route);
  ASSERT_NO_FATAL_FAILURE(startWithAction({"--load-folder", folder.path("")}));
  EXPECT_TRUE(call("pause").success);
  EXPECT_TRUE(standsSaying("paused until ~resume"));
  const std::size_t from = commands_.count();
  ASSERT_NO_FATAL_FAILURE(replaceBy("route.yaml"));
  EXPECT_FALSE(test::waitFor(
      [&] {
        const auto all = commands_.all();
        return std::any_of(all.begin() + static_cast<std::ptrdiff_t>(from), all.end(),
                           test::drives);
      },
      std::chrono::seconds(3)))
      << "it is read in a fraction of that";
  EXPECT_TRUE(call("resume").success);
  EXPECT_TRUE(flies()) << said();
}

// Of a client that plans anew: whoever has paused the vehicle saw it fly off.
TEST_F(ActionHoldsTest, APauseOutlivesTheGoalThatIsCancelled) {
  ASSERT_NO_FATAL_FAILURE(startWithAction());
  EXPECT_TRUE(call("pause").success);
  EXPECT_TRUE(standsSaying("paused until ~resume"));
  ros::Publisher cancels = nh_.advertise<actionlib_msgs::GoalID>("navigate_path/cancel", 1);
  ASSERT_TRUE(test::waitFor([&] { return cancels.getNumSubscribers() > 0; }));
  cancels.publish(actionlib_msgs::GoalID());
  ASSERT_TRUE(results_.waitForMoreThan(0));
  sendGoal(sky_.now());
  EXPECT_TRUE(standsSaying("paused until ~resume"));
  EXPECT_TRUE(call("resume").success);
  EXPECT_TRUE(flies()) << said();
}

// What was measured went into the setpoints as it came: 60 of 60 were NaN.
TEST_F(HoldsTest, OdometryThatIsNotFiniteMakesNoSetpointThatIsNot) {
  Latest<geometry_msgs::TwistStamped> setpoints(nh_, "setpoint_velocity");
  ros::Publisher odometry = nh_.advertise<nav_msgs::Odometry>("odom", 1);
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_TRUE(test::waitFor([&] { return odometry.getNumSubscribers() > 0; }));
  sendGoal(ros::Time());
  const std::size_t before = setpoints.count();
  ASSERT_TRUE(test::waitFor([&] {
    nav_msgs::Odometry message;
    message.header.stamp = sky_.now();
    message.twist.twist.angular.z = std::numeric_limits<double>::quiet_NaN();
    odometry.publish(message);
    return setpoints.count() > before + 60;
  }));
  for (const geometry_msgs::TwistStamped& setpoint : setpoints.all()) {
    const auto& v = setpoint.twist;
    EXPECT_TRUE(std::isfinite(v.linear.x + v.linear.y + v.linear.z + v.angular.z));
  }
}

TEST_F(HoldsTest, APathForAGoalThatWasReachedIsNotFlown) {
  ASSERT_NO_FATAL_FAILURE(start());
  const ros::Time goal = sky_.now();
  sendPath(goal, {0.0, 0.05});
  ASSERT_TRUE(says("ARRIVED")) << said();
  sendPath(goal, {0.0, 40.0});
  EXPECT_TRUE(pilot_->says("A path is not flown: its goal was reached or cancelled"));
}

TEST_F(HoldsTest, APathIsFlownUntilAnEmptyOneComes) {
  ASSERT_NO_FATAL_FAILURE(start());
  sendPath(sky_.now(), {0.0, 10.0, 20.0, 40.0});
  ASSERT_TRUE(flies()) << said();
  sendPath(sky_.now(), {});
  EXPECT_TRUE(says("CANCELLED: cancelled: the path is empty")) << said();
  EXPECT_TRUE(endsInAZero());
}

TEST_F(HoldsTest, WhatIsFromBeforeTheStartIsNotFlown) {
  sendPath(sky_.now(), {0.0, 10.0, 20.0, 40.0});
  const ros::Time before = sky_.now();
  ASSERT_TRUE(test::waitFor([&] { return sky_.now() > before + ros::Duration(1.0); }));
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_TRUE(pilot_->says("A path stamped"));
  sendGoal(before);
  ASSERT_TRUE(pilot_->says("A goal stamped"));
  const ros::Time then = sky_.now();
  ASSERT_TRUE(test::waitFor([&] { return sky_.now() > then + ros::Duration(1.0); }));
  EXPECT_EQ(commands_.count(), 0u);
  EXPECT_TRUE(says("IDLE")) << said();
  sendPath(sky_.now(), {0.0, 10.0, 20.0, 40.0});
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, TfThatCeasesStopsIt) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  sky_.tf_comes = false;
  EXPECT_TRUE(standsSaying("TRANSFORM_ERROR"));
  sky_.tf_comes = true;
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, AClockThatStandsStillStopsIt) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  sky_.clock_runs = false;
  EXPECT_TRUE(standsSaying("ROS time stands still"));
  sky_.clock_runs = true;
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, TimeThatGoesBackCancelsAndANewGoalIsFlown) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  const ros::Time old = sky_.now();
  sky_.jumpTo(5e8);
  EXPECT_TRUE(says("CANCELLED: time went back")) << said();
  EXPECT_TRUE(endsInAZero());
  sendGoal(old);
  EXPECT_TRUE(pilot_->says("s ahead of the time here"));
  sendGoal(sky_.now());
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, ACloudStampedZeroBlindsNobody) {
  sky_.clouds_come = false;
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_TRUE(says("IDLE"));
  const ros::Time before = sky_.now();  // tf is known
  ASSERT_TRUE(test::waitFor([&] { return sky_.now() > before + ros::Duration(0.5); }));
  sky_.sendCloud(ros::Time());
  sendGoal(sky_.now());
  EXPECT_TRUE(says("NO_CLOUD")) << said();
  sky_.clouds_come = true;
  EXPECT_TRUE(flies()) << said();
}

// Under the sanitizers the node ended when it remembered nothing and someone asked to see that: the
// iterator over a cloud without points took a reference to its first byte.
TEST_F(HoldsTest, NothingRememberedIsShownAsACloudWithoutPoints) {
  const Latest<sensor_msgs::PointCloud2> remembered(nh_, "remembered_points");
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  const auto cloud = remembered.waitFor(0, [](const auto& cloud) { return cloud.width == 0; });
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->fields.size(), 3U);
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, SigtermInFlightIsFollowedByAZero) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  pilot_->end(SIGTERM);
  EXPECT_TRUE(endsInAZero());
}

}  // namespace
}  // namespace grid_path_planner::nodes
