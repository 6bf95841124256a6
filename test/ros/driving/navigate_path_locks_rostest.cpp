// A law of structure: the thread that commands the vehicle takes no lock that code holds which reads or
// writes files, handles maps, publishes or logs. Watched from outside, by support/lock_watch.cpp. And of its
// priority the diagnostics tell the truth.
#include <actionlib/client/simple_action_client.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <sched.h>

#include <filesystem>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/still_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::pathOf;
using test::Process;
using test::StillWorld;

class ControlThread : public test::StillTest {
 protected:
  // The number behind `name: ` in the report.
  int counted(const std::string& name) const {
    const std::string text = test::contentOf(report_);
    const std::size_t at = text.find(name + ": ");
    return at == std::string::npos ? -1 : std::stoi(text.substr(at + name.size() + 2));
  }
  void publishMap() {
    grid::OccupancyGrid map(grid::GridGeometry(200, 200, 0.5));
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

TEST_F(ControlThread, TakesNoLockThatFilesMapsOrLogsAreHandledUnder) {
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
  EXPECT_GT(counted("control"), 0) << "the thread is watched";
  EXPECT_GT(counted("slow"), 0) << "the others are";
  const std::string text = test::contentOf(report_);
  EXPECT_EQ(text.find("both: "), std::string::npos) << text;
}

// SCHED_FIFO or SCHED_OTHER; -1 before there is such a thread.
int policyOfThread(pid_t process, const std::string& name) {
  namespace fs = std::filesystem;
  for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(process) + "/task"))
    if (test::contentOf((task.path() / "comm").string()) == name + "\n")
      return ::sched_getscheduler(std::stoi(task.path().filename().string()));
  return -1;
}

TEST_F(ControlThread, HasThePriorityOfTheDiagnostics) {
  StillWorld world(100.0);
  drive();
  const std::string key = "scheduling of commands";
  ASSERT_TRUE(test::waitFor([&] { return !reported(key).empty(); }));
  const bool granted = reported(key) == "real-time priority 1";
  if (!granted) {
    EXPECT_EQ(reported(key), "ordinary: Operation not permitted");
  }
  EXPECT_EQ(policyOfThread(navigate_->pid(), "control"), granted ? SCHED_FIFO : SCHED_OTHER);

  dynamic_reconfigure::Reconfigure call;
  call.request.config.ints.emplace_back();
  call.request.config.ints.back().name = "realtime_priority";
  call.request.config.ints.back().value = 0;
  ASSERT_TRUE(ros::service::call("/navigate_path/set_parameters", call));
  EXPECT_TRUE(test::waitFor([&] { return reported(key) == "ordinary"; }));
  EXPECT_EQ(policyOfThread(navigate_->pid(), "control"), SCHED_OTHER);
  EXPECT_TRUE(isDriving());
}

}  // namespace
}  // namespace grid_path_planner::nodes
