// A law of structure: the thread that commands the vehicle takes no lock that code holds which reads or
// writes files, handles maps, publishes or logs. Watched from outside, by support/lock_watch.cpp. And of its
// priority the diagnostics tell the truth, and however long a tick is, the others get a processor.
#include <actionlib/client/simple_action_client.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <sched.h>

#include <chrono>
#include <thread>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/control_thread.h"
#include "ros/support/still_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::pathOf;
using test::Process;
using test::StillWorld;

class NavigatePathLocks : public test::StillTest {
 protected:
  void publishMap(int side = 200) {
    grid::OccupancyGrid map(grid::GridGeometry(side, side, 100.0 / side));
    for (std::int8_t& value : map.values()) value = 0;
    maps_.publish(occupancyToMessage(map, "map", ros::Time::now()));
    map_msgs::OccupancyGridUpdate update;
    update.header.frame_id = "map";
    update.header.stamp = ros::Time::now();
    update.width = update.height = 10;
    update.data.assign(100, 0);
    updates_.publish(update);
  }
  // What the slow side of the node is there for, all of it.
  void keepBusy(const std::string& waypoints) {
    actionlib::SimpleActionClient<NavigatePathAction> client("navigate_path", true);
    ASSERT_TRUE(test::waitFor([&] { return client.isServerConnected(); }));
    for (int round = 0; round < 5; ++round) {
      publishMap();
      NavigatePathGoal goal;
      goal.filename = waypoints;
      client.sendGoal(goal);
      ASSERT_TRUE(test::waitFor([&] { return ask("pause"); }));
      EXPECT_TRUE(ask("resume"));
      dynamic_reconfigure::Reconfigure call;
      EXPECT_TRUE(ros::service::call("/navigate_path/set_parameters", call));
      const std::size_t reports = diagnostics_.count();
      EXPECT_TRUE(test::waitFor([&] { return diagnostics_.count() > reports; }));
      EXPECT_TRUE(ask("cancel"));
    }
  }

  const test::TemporaryFolder folder_;
  const std::string report_ = folder_.path("report");
  ros::Publisher maps_ = nh_.advertise<nav_msgs::OccupancyGrid>("projected_map", 1, true);
  ros::Publisher updates_ =
      nh_.advertise<map_msgs::OccupancyGridUpdate>("projected_map_updates", 10);
};

TEST_F(NavigatePathLocks, TakesNoLockThatFilesMapsOrLogsAreHandledUnder) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizers watch the same calls";
#endif
  StillWorld world(100.0);
  path::writeWaypointFile(base::OutputFile(folder_.path("line.yaml")), pathOf({{0, 0}, {50, 0}}));
  navigate_ = std::make_unique<Process>(
      std::vector<std::string>{"env", "LD_PRELOAD=" GPP_LOCK_WATCH, "LOCK_WATCH_REPORT=" + report_,
                               GPP_DEVEL "/lib/grid_path_planner/navigate_path", "--load-folder",
                               folder_.path("."), "_no_progress_timeout:=0", "_tf_timeout:=3.0"});
  ASSERT_TRUE(test::waitFor([&] { return paths_.getNumSubscribers() > 0; }));
  keepBusy("line.yaml");
  navigate_->end(SIGINT);
  ASSERT_EQ(navigate_->exitCode(), 0);
  EXPECT_TRUE(test::takesNoSlowLock(report_));
}

TEST_F(NavigatePathLocks, HasThePriorityOfTheDiagnostics) {
  StillWorld world(100.0);
  drive();
  const std::string key = "scheduling of commands";
  ASSERT_TRUE(test::waitFor([&] { return !reported(key).empty(); }));
  const bool granted = reported(key) == "real-time priority 1";
  if (!granted) {
    EXPECT_EQ(reported(key), "ordinary: Operation not permitted");
  }
  const auto thread = test::controlThreadOf(navigate_->pid());
  EXPECT_EQ(test::policyOf(thread), granted ? SCHED_FIFO : SCHED_OTHER);

  dynamic_reconfigure::Reconfigure call;
  call.request.config.ints.emplace_back();
  call.request.config.ints.back().name = "realtime_priority";
  call.request.config.ints.back().value = 0;
  ASSERT_TRUE(ros::service::call("/navigate_path/set_parameters", call));
  EXPECT_TRUE(test::waitFor([&] { return reported(key) == "ordinary"; }));
  EXPECT_EQ(test::policyOf(thread), SCHED_OTHER);
  EXPECT_TRUE(isDriving());
}

// Any client may set check_radius: before a real-time thread that never sleeps nobody would come, on a machine of
// one processor not even the stop.
TEST_F(NavigatePathLocks, TakesHalfOfAProcessorAtMost) {
  StillWorld world(100.0);
  publishMap(2000);
  startNavigate({"_check_map:=true", "_check_radius:=100", "_no_progress_timeout:=0"});
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(isDriving());
  const auto thread = test::controlThreadOf(navigate_->pid());
  const auto begin = std::chrono::steady_clock::now();
  const double before = test::secondsOf(thread);
  std::this_thread::sleep_for(std::chrono::seconds(3));
  const double used = test::secondsOf(thread) - before;
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(used, 0.1) << "no long ticks";
  EXPECT_LT(used, 0.6 * passed.count());
  EXPECT_TRUE(isDriving());
}

}  // namespace
}  // namespace grid_path_planner::nodes
