// What local_planner commands waits for nobody.
//
// What was seen before: the thread that unpacked clouds, planned and logged commanded, too. A log that nobody read
// silenced cmd_vel for ever, and then the plans; clouds of 16 MB silenced it for as long as they took. A plan that was
// late was given the last answer for the vehicle's velocity, where braked ones had been sent.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/this_node.h>
#include <rosgraph_msgs/Log.h>
#include <sched.h>
#include <sensor_msgs/Image.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "grid_path_planner/NavigatePathActionGoal.h"
#include "grid_path_planner/avoidance/flight_log.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/support/control_thread.h"
#include "ros/support/flight_fixture.h"
#include "ros/support/unread_log.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using geometry_msgs::Twist;
using test::drives;
using test::Latest;
using test::Process;

class LocalPlannerLocks : public test::FlightTest {
 protected:
  // Whether zeros come for a second, and nothing else.
  bool standsForASecond() const {
    const std::size_t seen = commands_.count();
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const auto all = commands_.all();
    return all.size() > seen &&
           std::none_of(all.begin() + static_cast<std::ptrdiff_t>(seen), all.end(), drives);
  }
  static std::vector<std::string> command() {
    std::vector<std::string> all = arguments();
    all.insert(all.begin(), GPP_DEVEL "/lib/grid_path_planner/local_planner");
    return all;
  }
  // Each has a line in the log.
  void refuseGoals() const {
    geometry_msgs::PoseStamped refused;
    refused.header.frame_id = "map";
    refused.pose.position.x = 1e180;
    for (int i = 0; i < 200; ++i) {
      goals_.publish(refused);
      ros::WallDuration(0.002).sleep();
    }
  }

  const test::TemporaryFolder folder_;
  Latest<diagnostic_msgs::DiagnosticArray> diagnostics_{nh_, "/diagnostics"};
  Latest<rosgraph_msgs::Log> log_{nh_, "/rosout"};
};

TEST_F(LocalPlannerLocks, ALogThatNobodyReadsLosesLinesInAPipe) {
  const std::string pipe = folder_.path("pipe");
  pilot_ = std::make_unique<Process>(test::withUnreadPipe(pipe, command()));
  ASSERT_NO_FATAL_FAILURE(waitUntilItIsUp());
  test::fillPipe(pipe);
  refuseGoals();
  sendGoal(ros::Time());
  ASSERT_TRUE(flies()) << said();
  const std::size_t lines = log_.count();
  refuseGoals();
  EXPECT_TRUE(log_.waitFor(lines, [](const rosgraph_msgs::Log& line) {
    return line.level >= rosgraph_msgs::Log::WARN && line.name != ros::this_node::getName();
  })) << "what the pipe loses";
  const std::size_t reports = diagnostics_.count();
  EXPECT_TRUE(diagnostics_.waitForMoreThan(reports + 1));
  EXPECT_TRUE(flies()) << said();
  pilot_->end(SIGINT);
  EXPECT_EQ(pilot_->exitCode(), 0);
  EXPECT_TRUE(endsInAZero());
}

TEST_F(LocalPlannerLocks, ALogThatNobodyReadsEndsInZeros) {
  pilot_ = std::make_unique<Process>(test::withUnreadSocket(command()));
  ASSERT_NO_FATAL_FAILURE(waitUntilItIsUp());
  sendGoal(ros::Time());
  ASSERT_TRUE(flies()) << said();
  EXPECT_TRUE(test::waitFor([&] {  // the log is full: the node's slow side says nothing
    refuseGoals();
    const std::size_t reports = diagnostics_.count();
    return standsForASecond() && diagnostics_.count() == reports;
  }));
  send(manuals_, true);
  EXPECT_TRUE(test::waitFor([&] {
    send(manuals_, true);
    const std::size_t seen = commands_.count();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    return commands_.count() == seen;
  })) << "and the joystick's velocities are in force";
  pilot_->signal(SIGKILL);  // the log holds its orderly end
}

sensor_msgs::PointCloud2 largeCloud(std::uint32_t height = 1024) {  // 16 kB a row
  constexpr std::uint32_t kWidth = 1280;
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(kWidth * height);
  cloud.header.frame_id = "camera";
  cloud.width = kWidth;
  cloud.height = height;
  cloud.row_step = kWidth * cloud.point_step;
  std::fill(cloud.data.begin(), cloud.data.end(), std::uint8_t{0xff});  // NaN
  return cloud;
}

// Each plan says where it leads: with the velocities in the same thread there were as many of the one as of the other.
TEST_F(LocalPlannerLocks, LargeCloudsAndSlowViewersDelayPlansAndNoVelocities) {
  Latest<trajectory_msgs::MultiDOFJointTrajectory> plans(nh_, "setpoint_trajectory");
  ros::Publisher clouds = nh_.advertise<sensor_msgs::PointCloud2>("points", 1);
  ASSERT_NO_FATAL_FAILURE(startAndFly({"_control_rate:=200"}));
  Process viewer(std::vector<std::string>{"rostopic", "echo", "/avoidance_markers"});
  ASSERT_TRUE(viewer.says("header"));
  viewer.signal(SIGSTOP);
  ASSERT_TRUE(plans.waitForMoreThan(0));
  sensor_msgs::PointCloud2 cloud = largeCloud();
  const std::size_t ahead = commands_.count() - std::min(commands_.count(), plans.count());
  EXPECT_TRUE(test::waitFor([&] {
    cloud.header.stamp = sky_.now();
    clouds.publish(cloud);
    return commands_.count() > plans.count() + ahead + 300;
  })) << commands_.count()
      << " velocities, " << plans.count() << " plans";
  viewer.signal(SIGKILL);
  EXPECT_TRUE(flies()) << said();
}

// Whether an update of a flight log, which may still be written, was given a velocity that was less than the answer
// before it, and no stand: where a plan comes after the braking, there is nothing to tell the two by.
bool wasGivenLess(const std::string& file) {
  bool less = false;
  base::BodyVelocity before;
  avoidance::replayFlight(file, [&](const auto& input, const auto& answer) {
    less = less || (input.velocity.surge > 0.0 && input.velocity.surge < 0.99 * before.surge);
    before = answer.velocity;
  });
  return less;
}

TEST_F(LocalPlannerLocks, WithoutOdometryALatePlanIsGivenTheVelocityThatWasSent) {
  const std::string log = folder_.path("late.flight");
  std::vector<std::string> command{GPP_DEVEL "/lib/grid_path_planner/local_planner", "--log", log};
  for (const std::string& argument :
       arguments({"_frame_period:=0.01", "_control_rate:=100", "_max_acceleration:=4"}))
    command.push_back(argument);
  pilot_ = std::make_unique<Process>(command);
  ASSERT_NO_FATAL_FAILURE(waitUntilItIsUp());
  sendGoal(ros::Time());
  ASSERT_TRUE(flies()) << said();
  ros::Publisher clouds = nh_.advertise<sensor_msgs::PointCloud2>("points", 1);
  // One of them takes a little longer than a period, whatever the machine.
  std::vector<sensor_msgs::PointCloud2> sizes{largeCloud(), largeCloud(256), largeCloud(64)};
  ASSERT_TRUE(test::waitFor([&] { return clouds.getNumSubscribers() > 0; }));
  const auto late = [&] {
    return test::valueIn(diagnostics_.all(), "braked for want of a newer plan");
  };
  std::string judged;
  std::size_t sent = 0;
  EXPECT_TRUE(test::waitFor([&] {
    for (sensor_msgs::PointCloud2& cloud : sizes) cloud.header.stamp = sky_.now();
    clouds.publish(sizes[sent++ / 20 % sizes.size()]);
    const std::string now = late();
    return now != std::exchange(judged, now) && std::stoi(now) > 5 && wasGivenLess(log);
  })) << late();
  EXPECT_TRUE(flies()) << said();
}

// As navigate_path's: see there.
TEST_F(LocalPlannerLocks, TakesNoLockThatCloudsFilesOrLogsAreHandledUnder) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizers watch the same calls";
#endif
  const std::string report = folder_.path("report");
  path::Path line;
  line.poses = {{{0.0, 0.0, 0.0}, 0.0}, {{40.0, 0.0, 0.0}, 0.0}};
  path::writeWaypointFile(base::OutputFile(folder_.path("line.yaml")), line);
  std::vector<std::string> command{"env",
                                   "LD_PRELOAD=" GPP_LOCK_WATCH,
                                   "LOCK_WATCH_REPORT=" + report,
                                   GPP_DEVEL "/lib/grid_path_planner/local_planner",
                                   "--load-folder",
                                   folder_.path("."),
                                   "--log",
                                   folder_.path("log.flight")};
  for (const std::string& argument : arguments()) command.push_back(argument);
  pilot_ = std::make_unique<Process>(command);
  ASSERT_NO_FATAL_FAILURE(waitUntilItIsUp());
  const Latest<sensor_msgs::Image> pictures(nh_, "histogram_image");
  const ros::Publisher files = nh_.advertise<NavigatePathActionGoal>("navigate_path/goal", 1, true);
  for (int round = 0; round < 5; ++round) {
    NavigatePathActionGoal goal;
    goal.goal_id.id = std::to_string(round);
    goal.goal.filename = "line.yaml";
    files.publish(goal);
    ASSERT_TRUE(flies()) << said();
    EXPECT_TRUE(call("pause").success);
    EXPECT_TRUE(call("resume").success);
    dynamic_reconfigure::Reconfigure reconfigure;
    EXPECT_TRUE(ros::service::call("/local_planner/set_parameters", reconfigure));
    send(stops_, true);
    ASSERT_TRUE(says("stopped by the topic /stop")) << said();
    send(stops_, false);
    const std::size_t seen = diagnostics_.count(), shown = pictures.count();
    EXPECT_TRUE(
        test::waitFor([&] { return diagnostics_.count() > seen && pictures.count() > shown; }));
    EXPECT_TRUE(call("cancel").success);
  }
  pilot_->end(SIGINT);
  ASSERT_EQ(pilot_->exitCode(), 0);
  EXPECT_TRUE(test::takesNoSlowLock(report));
}

TEST_F(LocalPlannerLocks, HasThePriorityOfTheDiagnostics) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  const auto reported = [&] { return test::valueIn(diagnostics_.all(), "scheduling of commands"); };
  ASSERT_TRUE(test::waitFor([&] { return !reported().empty(); }));
  const bool granted = reported() == "real-time priority 1";
  if (!granted) {
    EXPECT_EQ(reported(), "ordinary: Operation not permitted");
  }
  const auto thread = test::controlThreadOf(pilot_->pid());
  EXPECT_EQ(test::policyOf(thread), granted ? SCHED_FIFO : SCHED_OTHER);
  dynamic_reconfigure::Reconfigure call;
  call.request.config.ints.emplace_back();
  call.request.config.ints.back().name = "realtime_priority";
  call.request.config.ints.back().value = 0;
  ASSERT_TRUE(ros::service::call("/local_planner/set_parameters", call));
  EXPECT_TRUE(test::waitFor([&] { return reported() == "ordinary"; }));
  EXPECT_EQ(test::policyOf(thread), SCHED_OTHER);
  EXPECT_TRUE(flies()) << said();
}

}  // namespace
}  // namespace grid_path_planner::nodes
