// The control loop waits for nobody.
//
// What was seen before: everything ran in one thread. A waypoint file of 1,000, 5,000 or 20,000
// waypoints silenced cmd_vel for 0.2, 2 and 5.7 s; a log that nobody read, for ever; and a vehicle whose
// /clock stopped drove on.
#include <actionlib/client/simple_action_client.h>
#include <std_msgs/Bool.h>

#include <filesystem>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/support/still_fixture.h"
#include "ros/support/unread_log.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using path::Path;
using test::isZero;
using test::pathOf;
using test::Process;
using test::StillWorld;
using test::TemporaryFolder;

class NavigateLoop : public test::StillTest {};

TEST_F(NavigateLoop, ALogThatNobodyReadsDoesNotHoldIt) {
  StillWorld world(100.0);
  navigate_ = std::make_unique<Process>(
      test::withUnreadSocket({GPP_DEVEL "/lib/grid_path_planner/navigate_path", "_check_map:=false",
                              "_no_progress_timeout:=0", "_tf_timeout:=3.0"}));
  ASSERT_TRUE(test::waitFor([&] { return paths_.getNumSubscribers() > 0; }));
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(isDriving());
  nav_msgs::Path refused = pathToMessage(pathOf({{1e180, 0}}), ros::Time::now());
  std::size_t reports = 0;
  ASSERT_TRUE(test::waitFor([&] {  // until the slow side of the node says nothing for two seconds
    for (int i = 0; i < 200; ++i) {
      refused.header.stamp = ros::Time::now();
      paths_.publish(refused);
      ros::WallDuration(0.002).sleep();
    }
    reports = diagnostics_.count();
    return !test::waitFor([&] { return diagnostics_.count() > reports; }, std::chrono::seconds(2));
  }));
  EXPECT_TRUE(isDriving());
  ros::Publisher stop = nh_.advertise<std_msgs::Bool>("stop", 1, true);
  std_msgs::Bool on;
  on.data = true;
  stop.publish(on);
  EXPECT_TRUE(stops()) << "and it obeys";
  navigate_->signal(SIGKILL);  // the log holds its orderly end
}

// However long that takes: the file is not opened before the test says so.
TEST_F(NavigateLoop, AWaypointFileIsReadElsewhere) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer wants to be the first that is loaded";
#endif
  StillWorld world(100.0);
  const TemporaryFolder folder{testing::TempDir()};
  const std::string file = folder.path("route.yaml");
  path::writeWaypointFile(file, pathOf({{0, 0}, {40, 0}, {50, 0}}));
  navigate_ = std::make_unique<Process>(std::vector<std::string>{
      "env", "LD_PRELOAD=" GPP_HELD_FILE, "HELD_FILE=" + std::filesystem::canonical(file).string(),
      GPP_DEVEL "/lib/grid_path_planner/navigate_path", "_check_map:=false", "_tf_timeout:=3.0",
      "_no_progress_timeout:=0"});
  ASSERT_TRUE(test::waitFor([&] { return paths_.getNumSubscribers() > 0; }));
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(isDriving());
  actionlib::SimpleActionClient<NavigatePathAction> client("navigate_path", false);
  ASSERT_TRUE(test::waitFor([&] { return client.isServerConnected(); }));
  NavigatePathGoal goal;
  goal.filename = file;
  client.sendGoal(goal);
  ASSERT_TRUE(test::waitFor([&] { return std::filesystem::exists(file + ".waits"); }));
  const std::size_t before = velocity_.count();
  EXPECT_TRUE(velocity_.waitForMoreThan(before + 100)) << "it commands nothing while it reads";
  EXPECT_TRUE(isDriving());
  folder.write("route.yaml.goes_on", "");
  EXPECT_TRUE(navigate_->says("drives a path of 3 waypoints")) << "and then what it has read";
}

TEST_F(NavigateLoop, AGoalWhoseFileIsReadCanBeCancelled) {
  StillWorld world(100.0);
  const TemporaryFolder folder{testing::TempDir()};
  const std::string file = folder.path("route.yaml");
  Path path;
  for (int i = 0; i < 20000; ++i) path.poses.push_back({{0.01 * i, 0, 0}, 0.0});
  path::writeWaypointFile(file, path);
  startNavigate();
  actionlib::SimpleActionClient<NavigatePathAction> client("navigate_path", false);
  ASSERT_TRUE(test::waitFor([&] { return client.isServerConnected(); }));
  NavigatePathGoal goal;
  goal.filename = file;
  client.sendGoal(goal);
  client.cancelGoal();
  ASSERT_TRUE(test::waitFor([&] { return client.getState().isDone(); }));
  // actionlib itself answers, without a word, where the cancel comes before the goal.
  if (client.getState() != actionlib::SimpleClientGoalState::RECALLED) {
    EXPECT_EQ(client.getResult()->status, "CANCELLED");
  }
  goal.filename = "/no/such/file.yaml";
  client.sendGoal(goal);
  ASSERT_TRUE(test::waitFor([&] { return client.getState().isDone(); }));
  EXPECT_EQ(client.getResult()->status, "INVALID_REQUEST");
}

TEST_F(NavigateLoop, AClockThatStopsEndsInAZeroAndGoesOn) {
  auto world = std::make_unique<StillWorld>(100.0);
  drive();
  const double time = world->time();
  world.reset();
  EXPECT_TRUE(stops());
  EXPECT_TRUE(navigate_->says("ROS time stands still"));
  world = std::make_unique<StillWorld>(time);
  EXPECT_TRUE(isDriving());
}

}  // namespace
}  // namespace grid_path_planner::nodes
