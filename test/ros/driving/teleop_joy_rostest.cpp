#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <std_msgs/Bool.h>

#include "ros/support/control_thread.h"
#include "ros/support/latest.h"
#include "ros/support/navigate_fixture.h"
#include "ros/support/nodelet_command.h"
#include "ros/support/process.h"
#include "ros/support/unread_log.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using geometry_msgs::Twist;
using test::isZero;
using test::Latest;
using test::Process;

sensor_msgs::Joy joyOf(float surge, bool deadman) {
  sensor_msgs::Joy message;
  message.axes.assign(8, 0.0f);
  message.axes[1] = surge;
  message.buttons.assign(11, 0);
  message.buttons[4] = deadman;
  return message;
}

class TeleopJoyTest : public testing::Test {
 protected:
  TeleopJoyTest() { ros::param::del("/teleop_joy"); }

  void start(const std::vector<std::string>& arguments = {}) {
    node_ = std::make_unique<Process>("teleop_joy", arguments);
    ASSERT_NO_FATAL_FAILURE(waitUntilItIsUp());
  }
  void startBy(const std::vector<std::string>& command) {
    node_ = std::make_unique<Process>(command);
    ASSERT_NO_FATAL_FAILURE(waitUntilItIsUp());
  }
  void waitUntilItIsUp() {
    ASSERT_TRUE(
        test::waitFor([&] { return joy_.getNumSubscribers() > 0 && commands_.publishers() > 0; }));
  }

  // Sends `message` until a command comes that `accept` takes.
  template <class Accept>
  bool sendUntil(const sensor_msgs::Joy& message, Accept accept) {
    const std::size_t seen = commands_.count();
    return test::waitFor([&] {
      joy_.publish(message);
      const auto all = commands_.all();
      return all.size() > seen && accept(all.back());
    });
  }
  bool driveAhead() {
    return sendUntil(joyOf(1.0f, true), [](const Twist& t) { return t.linear.x == 0.8; });
  }
  bool lastCommandIsZero() {
    return test::waitFor([&] { return isZero(commands_.all().back()); });
  }

  // Each time the node logs two lines.
  void takeOverAndLetGo(int times) {
    for (int i = 0; i < times; ++i) {
      joy_.publish(joyOf(1.0f, true));
      ros::WallDuration(0.001).sleep();
      joy_.publish(joyOf(0.0f, false));
      ros::WallDuration(0.001).sleep();
    }
  }

  ros::NodeHandle nh_;
  Latest<Twist> commands_{nh_, "cmd_vel"};
  ros::Publisher joy_ = nh_.advertise<sensor_msgs::Joy>("joy", 10);
  std::unique_ptr<Process> node_;
};

TEST_F(TeleopJoyTest, LettingTheDeadmanButtonGoStopsTheVehicleOnceAndLeavesItToOthers) {
  start({"_joy_timeout:=30"});
  ASSERT_TRUE(driveAhead());
  for (int i = 0; i < 5; ++i) joy_.publish(joyOf(1.0f, false));
  ASSERT_TRUE(lastCommandIsZero());
  const std::size_t seen = commands_.count();
  // What comes next is of the next drive: between the two there was nothing.
  ASSERT_TRUE(driveAhead());
  EXPECT_FALSE(isZero(commands_.all()[seen]));
}

// A joystick whose cable was pulled, or whose driver died, must not let the vehicle drive on.
TEST_F(TeleopJoyTest, AJoystickThatFallsSilentStopsTheVehicle) {
  start({"_joy_timeout:=0.3"});
  ASSERT_TRUE(driveAhead());
  EXPECT_TRUE(lastCommandIsZero());
  EXPECT_TRUE(node_->says("Nothing has come from the joystick"));
  EXPECT_TRUE(driveAhead()) << "when it speaks again";
}

TEST_F(TeleopJoyTest, AMessageThatCannotBeUsedStopsTheVehicleAndSaysWhy) {
  start({"_joy_timeout:=30"});
  ASSERT_TRUE(driveAhead());
  sensor_msgs::Joy few;
  few.axes.assign(2, 1.0f);
  few.buttons.assign(5, 1);
  joy_.publish(few);
  EXPECT_TRUE(lastCommandIsZero());
  EXPECT_TRUE(node_->says("fast_button is 5, but the joystick has 5"));
}

TEST_F(TeleopJoyTest, ItsEndStopsTheVehicle) {
  start({"_joy_timeout:=30"});
  ASSERT_TRUE(driveAhead());
  node_->signal(SIGINT);
  ASSERT_TRUE(node_->waitForExit());
  EXPECT_TRUE(lastCommandIsZero());
}

TEST_F(TeleopJoyTest, DrivesTheSimulatedVehicle) {
  ros::param::del("/simulator");
  Latest<nav_msgs::Odometry> odom(nh_, "odom");
  Process simulator("simulator", {"_real_time_factor:=5"});
  start({"_command_rate:=200"});
  EXPECT_TRUE(test::waitFor([&] {
    joy_.publish(joyOf(1.0f, true));
    const auto all = odom.all();
    return !all.empty() && all.back().pose.pose.position.x > 1.0;
  }));
}

// Before, the thread that commanded wrote the log: cmd_vel was silent for ever.
TEST_F(TeleopJoyTest, ALogThatNobodyReadsDoesNotHoldIt) {
  Latest<std_msgs::Bool> manual(nh_, "manual_control");
  ASSERT_NO_FATAL_FAILURE(
      startBy(test::withUnreadSocket({GPP_DEVEL "/lib/grid_path_planner/teleop_joy"})));
  takeOverAndLetGo(1500);
  ASSERT_TRUE(driveAhead());
  const auto newest = [&] { return manual.count() > 0 && manual.all().back().data != 0; };
  EXPECT_TRUE(test::waitFor([&] {
    joy_.publish(joyOf(1.0f, true));
    return newest();
  }));
  EXPECT_TRUE(lastCommandIsZero()) << "the joystick is silent";
  EXPECT_TRUE(test::waitFor([&] { return !newest(); }));
  node_->signal(SIGKILL);  // the log holds its orderly end
}

// As navigate_path's: see navigate_path_locks_rostest.cpp.
TEST_F(TeleopJoyTest, TakesNoLockThatLogsAreWrittenUnder) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizers watch the same calls";
#endif
  const test::TemporaryFolder folder;
  const std::string report = folder.path("report");
  Latest<diagnostic_msgs::DiagnosticArray> diagnostics(nh_, "/diagnostics");
  ASSERT_NO_FATAL_FAILURE(
      startBy({"env", "LD_PRELOAD=" GPP_LOCK_WATCH, "LOCK_WATCH_REPORT=" + report,
               GPP_DEVEL "/lib/grid_path_planner/teleop_joy"}));
  takeOverAndLetGo(20);
  ASSERT_TRUE(driveAhead());
  ASSERT_TRUE(test::waitFor(
      [&] { return !test::valueIn(diagnostics.all(), "scheduling of commands").empty(); }));
  node_->end(SIGINT);
  ASSERT_EQ(node_->exitCode(), 0);
  EXPECT_TRUE(test::takesNoSlowLock(report));
}

TEST_F(TeleopJoyTest, HasThePriorityOfTheDiagnostics) {
  Latest<diagnostic_msgs::DiagnosticArray> diagnostics(nh_, "/diagnostics");
  start();
  const auto reported = [&] { return test::valueIn(diagnostics.all(), "scheduling of commands"); };
  ASSERT_TRUE(test::waitFor([&] { return !reported().empty(); }));
  const bool granted = reported() == "real-time priority 1";
  EXPECT_TRUE(granted || reported() == "ordinary: Operation not permitted") << reported();
  EXPECT_EQ(test::policyOf(test::controlThreadOf(node_->pid())),
            granted ? SCHED_FIFO : SCHED_OTHER);
}

TEST_F(TeleopJoyTest, RunsAsANodelet) {
  Process manager(test::nodeletCommand({"standalone", "grid_path_planner/teleop_joy"}));
  EXPECT_TRUE(driveAhead());
}

}  // namespace
}  // namespace grid_path_planner::nodes
