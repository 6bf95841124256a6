// navigate_path drives what it is given, and refuses what cannot be driven.
#include <geometry_msgs/PoseStamped.h>

#include <limits>

#include "grid_path_planner/path/waypoint_file.h"
#include "ros/support/navigate_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {

using path::Path;
using path::writeWaypointFile;

namespace {

using test::Latest;
using test::pathOf;
using test::Process;
using test::TemporaryFolder;
using NavigateDrive = test::NavigateTest;

TEST_F(NavigateDrive, AWaypointFileToItsEnd) {
  const TemporaryFolder folder;
  const std::string file = folder.path("drive.yaml");
  const Path path = pathOf({{0, 0}, {2, 0, -0.5}, {2, 2, -1.0, 1.5}});
  writeWaypointFile(file, path);
  Latest<geometry_msgs::PoseStamped> waypoint(nh_, "current_waypoint");
  startSimulator();
  startNavigate({"--config-filename", file}, false);
  publishPath(pathOf({{-5, -5}}));  // is ignored
  ASSERT_TRUE(arrivesAt(2, 2));
  EXPECT_TRUE(staysStill());
  EXPECT_LT((pose().position - path.poses.back().position).norm(), 0.1);
  EXPECT_NEAR(pose().yaw, 1.5, 0.1);
  const auto last = waypoint.waitFor(
      0, [](const geometry_msgs::PoseStamped& p) { return p.pose.position.y == 2.0; });
  ASSERT_TRUE(last);
  EXPECT_EQ(last->header.frame_id, "map");
}

TEST_F(NavigateDrive, ThePathOfTheTopicFromItsNearestPoint) {
  startSimulator({"_initial_x:=1.0"});
  startNavigate();
  publishPath(pathOf({{-3, 0}, {3, 0, 0, 0.8}}));
  ASSERT_TRUE(arrivesAt(3, 0));
  EXPECT_NEAR(pose().yaw, 0.8, 0.1);
  for (const nav_msgs::Odometry& o : odom_.all()) ASSERT_GT(o.pose.pose.position.x, 0.95);
  publishPath(pathOf({{3, 0}, {3, 2}}));
  EXPECT_TRUE(arrivesAt(3, 2)) << "the next one";
}

// A failed plan: the vehicle does not go on along the old path.
TEST_F(NavigateDrive, AnEmptyPathStopsTheVehicle) {
  startSimulator();
  startNavigate();
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(moves());
  publishPath(Path());
  EXPECT_TRUE(staysStill());
  publishPath(pathOf({{pose().position.x(), 1.0}}));
  EXPECT_TRUE(moves()) << "the next path is driven";
}

TEST_F(NavigateDrive, ARestartedNodeDoesNotDriveYesterdaysPath) {
  startSimulator();
  startNavigate();
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(moves());
  navigate_.reset();
  ASSERT_TRUE(standsStill());
  startNavigate();  // the topic is latched
  EXPECT_TRUE(navigate_->says("is not driven: the node started at"));
  EXPECT_TRUE(staysStill());
  navigate_.reset();
  startNavigate({"_follow_latched:=true"});
  EXPECT_TRUE(moves()) << "where that is asked for";
}

TEST_F(NavigateDrive, APathInAnotherFrame) {
  startSimulator({"_initial_yaw:=1.0"});
  startNavigate();
  nav_msgs::Path message = pathToMessage(pathOf({{0, 0}, {1, 1, 0, 1}}), ros::Time::now());
  message.header.frame_id = "/odom";
  for (auto& pose : message.poses) pose.header.frame_id = "/map";
  paths_.publish(message);
  EXPECT_TRUE(arrivesAt(1, 1));
}

// It was refused, by other nodes than those that took a map without a frame for one in map_frame.
TEST_F(NavigateDrive, APathWithoutAFrameIsInTheMapFrame) {
  startSimulator({"_initial_x:=1.0", "_odom_frame:=site"});
  startNavigate();
  Path nameless = pathOf({{1, 0}, {2, 1}});
  nameless.frame_id = "";
  publishPath(nameless);
  EXPECT_TRUE(arrivesAt(2, 1));
}

TEST_F(NavigateDrive, AMapFrameThatTfDoesNotKnowIsNoneForAPathWithoutAFrame) {
  startSimulator();
  startNavigate({"_map_frame:=mars"});
  Path nameless = pathOf({{0, 0}, {1, 1}});
  nameless.frame_id = "";
  publishPath(nameless);
  EXPECT_TRUE(navigate_->says("the frame 'mars' is not known"));
}

TEST_F(NavigateDrive, PathsThatCannotBeDrivenAreRefusedAndTheDriveGoesOn) {
  startSimulator();
  startNavigate();
  publishPath(pathOf({{0, 0}, {20, 0}}));  // long enough for a test that stalls
  ASSERT_TRUE(moves());
  publishPath(pathOf({{0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0}}));
  EXPECT_TRUE(navigate_->says("The path is refused: pose 2 of the path"));
  publishPath(pathOf({{0, 0}, {1, 1}, {0, 1e180}}));
  EXPECT_TRUE(navigate_->says("The path is refused: pose 3 of the path"));
  Path elsewhere = pathOf({{0, 0}});
  elsewhere.frame_id = "mars";
  publishPath(elsewhere);
  EXPECT_TRUE(navigate_->says("the frame 'mars' is not known"));
  EXPECT_TRUE(arrivesAt(20, 0));
}

TEST_F(NavigateDrive, FilesAndParametersThatCannotBeUsedEndItBeforeItStarts) {
  const TemporaryFolder folder;
  const auto endsWithError = [&](const std::string& argument) {
    Process process("navigate_path", {argument});
    return process.waitForExit() && process.exitCode() == 1;
  };
  for (const char* text :
       {"waypoints: []\n",
        "waypoints:\n  - position: {x: 1e180, y: 0, z: 0}\n    orientation: {x: 0, y: 0, z: 0, w: "
        "1}\n"})
    EXPECT_TRUE(endsWithError("--config-filename=" + folder.write("bad.yaml", text))) << text;
  EXPECT_TRUE(endsWithError("--config-filename=/no/such/file.yaml"));
  ros::param::del("/navigate_path");
  EXPECT_TRUE(endsWithError("_max_speed:=-1.0"));
  ros::param::del("/navigate_path");
  EXPECT_TRUE(endsWithError("_mode:=sometimes"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
