// In which frame, by which transform and of which time local_planner takes what it is given, and that each of its sensors sees.
//
// By the code: a file in another frame was flown as if it were in map_frame; a path was laid there by the last transform that
// tf had, however long localization was dead; a goal in the vehicle's frame where the vehicle was when it came; a sensor
// that saw nothing any more counted as one that looks, while another one did.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <chrono>
#include <limits>
#include <string>
#include <thread>

#include "grid_path_planner/NavigatePathActionGoal.h"
#include "grid_path_planner/NavigatePathActionResult.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/support/control_thread.h"
#include "ros/support/flight_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::Latest;
using test::Process;
using test::waitFor;

class FramesTest : public test::FlightTest {
 protected:
  // Of the frame `site`, joined to the map at this moment.
  void join() {
    geometry_msgs::TransformStamped joint;
    joint.header.frame_id = "site";
    joint.header.stamp = sky_.now();
    joint.child_frame_id = "map";
    joint.transform.rotation.w = 1.0;
    broadcaster_.sendTransform(joint);
  }
  void pass(double seconds) {
    const ros::Time then = sky_.now();
    ASSERT_TRUE(waitFor([&] { return sky_.now() > then + ros::Duration(seconds); }));
  }
  // A path of 40 m, whose poses are in the frame `of_poses`.
  void sendPathIn(const std::string& frame, const std::string& of_poses) {
    nav_msgs::Path path;
    path.header.frame_id = frame;
    path.header.stamp = sky_.now();
    for (const double x : {0.0, 20.0, 40.0}) {
      path.poses.emplace_back();
      path.poses.back().header.frame_id = of_poses;
      path.poses.back().pose.position.x = x;
      path.poses.back().pose.orientation.w = 1.0;
    }
    paths_.publish(path);
  }
  bool drivesNow() const {
    const auto all = commands_.all();
    return !all.empty() && test::drives(all.back());
  }

  tf2_ros::TransformBroadcaster broadcaster_;
};

TEST_F(FramesTest, AFileInAnotherFrameThanTheMapsIsRefused) {
  const test::TemporaryFolder folder;
  path::writeWaypointFile(folder.path("site.yaml"), {"map", {{{40.0, 0.0, 0.0}, 0.0}}});
  Process refused("local_planner",
                  arguments({"--config-filename", folder.path("site.yaml"), "_map_frame:=odom"}));
  ASSERT_TRUE(refused.waitForExit());
  EXPECT_EQ(refused.exitCode(), 1);
  EXPECT_TRUE(refused.hasSaid("site.yaml: its waypoints are in frame 'map', map_frame is 'odom'"));
  ros::param::del("/local_planner");
  pilot_ = std::make_unique<Process>("local_planner",
                                     arguments({"--config-filename", folder.path("site.yaml")}));
  EXPECT_TRUE(flies()) << said();
}

TEST_F(FramesTest, APathThatAnOldTransformJoinsToTheMapIsNotFlown) {
  ASSERT_NO_FATAL_FAILURE(start());
  join();
  ASSERT_NO_FATAL_FAILURE(pass(2.0));
  sendPathIn("site", "site");
  EXPECT_TRUE(pilot_->says("The path is refused: the transform from site to map is"));
  sendPathIn("map", "site");
  EXPECT_TRUE(pilot_->says("pose 1 of the path cannot be transformed from 'site' to 'map'"));
  EXPECT_TRUE(says("IDLE")) << said();
  EXPECT_TRUE(waitFor([&] {
    join();
    sendPathIn("site", "site");
    return drivesNow();
  })) << said();
}

TEST_F(FramesTest, AGoalInTheVehiclesFrameIsWhereTheVehicleWasAtItsStamp) {
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_NO_FATAL_FAILURE(pass(1.0));
  geometry_msgs::PoseStamped goal;
  goal.header.frame_id = "base_link";
  goal.header.stamp = sky_.now() - ros::Duration(0.2);
  goal.pose.position.x = 30.0;
  goal.pose.orientation.w = 1.0;
  sky_.vehicle_x = 30.0;
  ASSERT_NO_FATAL_FAILURE(pass(0.5));
  goals_.publish(goal);
  EXPECT_TRUE(says("ARRIVED: arrived at")) << said();
}

TEST_F(FramesTest, ASensorThatSeesNothingAnyMoreIsMissedThoughAnotherSees) {
  ros::Publisher front = nh_.advertise<sensor_msgs::PointCloud2>("front/points", 10);
  const auto see = [&](float aside) {
    sensor_msgs::PointCloud2 cloud;
    cloud.header.frame_id = "camera";
    cloud.header.stamp = sky_.now();
    sensor_msgs::PointCloud2Modifier modifier(cloud);
    modifier.setPointCloud2FieldsByString(1, "xyz");
    modifier.resize(1);
    sensor_msgs::PointCloud2Iterator<float> x(cloud, "x");
    x[0] = aside;
    x[1] = x[2] = 0.0F;
    front.publish(cloud);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  };
  ASSERT_NO_FATAL_FAILURE(start({"_cloud_topics:=points front/points", "_cloud_timeout:=1"}));
  ASSERT_TRUE(waitFor([&] { return front.getNumSubscribers() > 0; }));
  sendGoal(ros::Time());
  ASSERT_TRUE(waitFor([&] {
    see(9.0F);
    return drivesNow();
  })) << said();
  EXPECT_TRUE(waitFor([&] {
    see(std::numeric_limits<float>::quiet_NaN());
    return !drivesNow() &&
           said().find(
               "NO_CLOUD: nothing that can be used has come on /front/points for longer "
               "than 1 s: it holds no point within range_min and range_max") != std::string::npos;
  })) << said();
  const Latest<diagnostic_msgs::DiagnosticArray> diagnostics(nh_, "/diagnostics");
  EXPECT_TRUE(waitFor([&] {
    see(std::numeric_limits<float>::quiet_NaN());
    return test::valueIn(diagnostics.all(), "/front/points").find("holds no point") !=
           std::string::npos;
  }));
  EXPECT_EQ(test::valueIn(diagnostics.all(), "/points"), "taken");
  EXPECT_TRUE(pilot_->hasSaid("A message on /front/points is refused: it holds no point"));
  EXPECT_TRUE(waitFor([&] {
    see(9.0F);
    return drivesNow();
  })) << said();
}

// By the code: the jump was noticed by the goal that came after it. Its client was told CANCELLED, the vehicle flew, and no cancel
// of the action reached it.
TEST_F(FramesTest, AGoalRightAfterTimeWentBackIsFlownAndNotToldItsEnd) {
  Latest<NavigatePathActionResult> results(nh_, "navigate_path/result");
  ros::Publisher goals = nh_.advertise<NavigatePathActionGoal>("navigate_path/goal", 1);
  ASSERT_NO_FATAL_FAILURE(start({"_control_rate:=2", "_frame_period:=0.5"}));
  ASSERT_TRUE(waitFor([&] { return goals.getNumSubscribers() > 0 && results.connected(); }));
  for (int i = 1; i <= 4; ++i) {
    sky_.jumpTo(1e9 - 1e8 * i);
    std::this_thread::sleep_for(std::chrono::milliseconds(60));  // of the period, half a second
    NavigatePathActionGoal goal;
    goal.goal_id.id = "goal " + std::to_string(i);
    goal.goal.path.header.frame_id = "map";
    goal.goal.path.poses.resize(1);
    goal.goal.path.poses[0].pose.position.x = 40.0;
    goal.goal.path.poses[0].pose.orientation.w = 1.0;
    goals.publish(goal);
    ASSERT_TRUE(flies()) << said();
    for (const NavigatePathActionResult& result : results.all())
      EXPECT_NE(result.status.goal_id.id, goal.goal_id.id) << result.result.message;
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
