#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/UInt32.h>
#include <tf2_ros/transform_listener.h>

#include <cmath>
#include <limits>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/latest.h"
#include "ros/support/nodelet_command.h"
#include "ros/support/process.h"
#include "support/ascii_map.h"

namespace grid_path_planner::nodes {
namespace {

using nav_msgs::Odometry;
using test::Latest;
using test::Process;

geometry_msgs::Twist twist(double surge, double yaw_rate = 0.0) {
  geometry_msgs::Twist message;
  message.linear.x = surge;
  message.angular.z = yaw_rate;
  return message;
}

// A simulator of its own for every test, and a commander that speaks for as long as it is told to.
class SimulatorTest : public testing::Test {
 protected:
  void start(std::vector<std::string> arguments, int real_time_factor = 10) {
    ros::param::del("/simulator");  // what the test before has set
    arguments.push_back("_real_time_factor:=" + std::to_string(real_time_factor));
    simulator_ = std::make_unique<Process>("simulator", arguments);
    ASSERT_TRUE(odom_.waitForMoreThan(odom_.count()));
    ASSERT_TRUE(test::waitFor([&] { return commands_.getNumSubscribers() > 0; }));
  }

  // Sends `message` until `condition` is met by the odometry.
  template <class Condition>
  std::optional<Odometry> driveUntil(const geometry_msgs::Twist& message, Condition condition) {
    std::optional<Odometry> found;
    test::waitFor([&] {
      commands_.publish(message);
      const auto all = odom_.all();
      if (!all.empty() && condition(all.back())) found = all.back();
      return found.has_value();
    });
    return found;
  }

  ros::NodeHandle nh_;
  Latest<Odometry> odom_{nh_, "odom"};
  ros::Publisher commands_ = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 10);
  std::unique_ptr<Process> simulator_;
};

TEST_F(SimulatorTest, DrivesAsCommandedAndSaysWhereItIs) {
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  start({"_initial_x:=2.0", "_initial_y:=3.0", "_initial_z:=-1.5", "_initial_yaw:=1.5708"});
  const auto odometry =
      driveUntil(twist(0.5), [](const Odometry& o) {  // not braking for want of commands
        return o.pose.pose.position.y > 4.0 && std::abs(o.twist.twist.linear.x - 0.5) < 1e-6;
      });
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->header.frame_id, "odom");
  EXPECT_EQ(odometry->child_frame_id, "base_link");
  EXPECT_NEAR(odometry->twist.twist.linear.x, 0.5, 1e-6);
  EXPECT_NEAR(odometry->pose.pose.position.x, 2.0, 0.01);
  EXPECT_NEAR(odometry->pose.pose.position.z, -1.5, 1e-9);
  ASSERT_TRUE(test::waitFor(
      [&] { return buffer.canTransform("map", "base_link", odometry->header.stamp); }));
  const auto transform = buffer.lookupTransform("map", "base_link", odometry->header.stamp);
  EXPECT_NEAR(transform.transform.translation.y, odometry->pose.pose.position.y, 1e-9);
  EXPECT_NEAR(transform.transform.rotation.z, odometry->pose.pose.orientation.z, 1e-9);
}

// A vehicle whose commander dies stops.
TEST_F(SimulatorTest, StopsWhenCommandsCease) {
  start({}, 1);  // 0.3 s of the clock below
  ASSERT_TRUE(
      driveUntil(twist(1.0), [](const Odometry& o) { return o.twist.twist.linear.x > 0.99; }));
  const std::size_t seen = odom_.count();
  ASSERT_TRUE(odom_.waitFor(seen, [](const Odometry& o) { return o.twist.twist.linear.x == 0.0; }));
  const std::vector<Odometry> all = odom_.all();
  const auto braking = std::find_if(all.begin() + seen, all.end(), [](const Odometry& o) {
    return o.twist.twist.linear.x < 0.99;
  });
  EXPECT_LE((braking->header.stamp - all[seen - 1].header.stamp).toSec(), 0.5 + 0.3);
}

TEST_F(SimulatorTest, TheClockRunsAtTheFactorAndBeginsWhereItIsTold) {
  Latest<rosgraph_msgs::Clock> clock(nh_, "/clock");
  const ros::SteadyTime before = ros::SteadyTime::now();
  start({"_start_time:=500.0"});
  ASSERT_TRUE(clock.waitForMoreThan(0));
  const ros::Time first = clock.all().front().clock;
  EXPECT_GE(first.toSec(), 500.0);
  const auto later = clock.waitFor(0, [&](const rosgraph_msgs::Clock& c) {
    return (c.clock - first).toSec() > 5.0 * (ros::SteadyTime::now() - before).toSec() - 2.0;
  });
  ASSERT_TRUE(later) << "faster than the wall clock";
  EXPECT_LE(later->clock.toSec(), 500.0 + 10.0 * (ros::SteadyTime::now() - before).toSec() + 1.0);
}

TEST_F(SimulatorTest, CountsContactsWithTheMap) {
  Latest<std_msgs::UInt32> contacts(nh_, "contacts");
  ros::Publisher maps = nh_.advertise<nav_msgs::OccupancyGrid>("projected_map", 1, true);
  maps.publish(occupancyToMessage(test::AsciiMap({"....#"}, 1.0).map, "/map", ros::Time(1.0)));
  start({"_initial_x:=1.5", "_initial_y:=0.5"});
  const auto none = contacts.waitForMoreThan(0);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->data, 0u);
  ASSERT_TRUE(driveUntil(twist(1.0), [](const Odometry& o) {
    return o.pose.pose.position.x > 3.7 - 1e-3 && o.twist.twist.linear.x == 0.0;
  }));
  ASSERT_TRUE(contacts.waitFor(1, [](const std_msgs::UInt32& c) { return c.data == 1; }));
  EXPECT_LE(odom_.all().back().pose.pose.position.x, 3.7 + 1e-6);
}

// It stood outside the map, and nothing said so before somebody gave it a goal.
TEST_F(SimulatorTest, AStartWhereItCannotDriveIsToldWithTheMap) {
  ros::Publisher maps = nh_.advertise<nav_msgs::OccupancyGrid>("projected_map", 1, true);
  maps.publish(occupancyToMessage(test::AsciiMap({"....#"}, 1.0).map, "/map", ros::Time(1.0)));
  start({"_initial_x:=50", "_initial_y:=0.5"});
  EXPECT_TRUE(simulator_->says("The vehicle starts at (50, 0.5), outside the map"));
  start({"_initial_x:=4.5", "_initial_y:=0.5"});
  EXPECT_TRUE(simulator_->says("The vehicle starts at (4.5, 0.5), in an occupied cell"));
  start({"_initial_x:=1.5", "_initial_y:=0.5"});
  ASSERT_TRUE(driveUntil(twist(1.0), [](const Odometry& o) {
    return o.pose.pose.position.x > 3.69 && o.twist.twist.linear.x == 0.0;
  }));
  EXPECT_FALSE(simulator_->hasSaid("The vehicle starts at"));
}

// The demo's vehicle drove on for 2 s of simulated time without a command, 1.8 m, because its
// commands came too late for a shorter timeout.
TEST_F(SimulatorTest, FasterThanRealTimeItWaitsForTheCommandThatIsDue) {
  start({"_max_acceleration:=100"});
  dynamic_reconfigure::Reconfigure call;
  dynamic_reconfigure::DoubleParameter factor;
  factor.name = "real_time_factor";
  factor.value = 100.0;
  call.request.config.doubles = {factor};
  ASSERT_TRUE(ros::service::call("/simulator/set_parameters", call));
  const std::size_t seen = odom_.count();
  const ros::SteadyTime begin = ros::SteadyTime::now();
  commands_.publish(twist(0.5));
  const auto moving =
      odom_.waitFor(seen, [](const Odometry& o) { return o.twist.twist.linear.x > 0.0; });
  ASSERT_TRUE(moving);
  const auto stopped = odom_.waitFor(seen, [&](const Odometry& o) {
    return (o.header.stamp - moving->header.stamp).toSec() > 1.0;
  });
  ASSERT_TRUE(stopped) << "it does not wait for ever";
  EXPECT_GE((ros::SteadyTime::now() - begin).toSec(), 0.2);
  EXPECT_EQ(stopped->twist.twist.linear.x, 0.0);
}

TEST_F(SimulatorTest, RefusesACommandThatIsNotFiniteAndLivesOn) {
  start({});
  for (int i = 0; i < 5; ++i) commands_.publish(twist(std::numeric_limits<double>::quiet_NaN()));
  const auto odometry =
      driveUntil(twist(0.5), [](const Odometry& o) { return o.twist.twist.linear.x > 0.4; });
  ASSERT_TRUE(odometry);
  EXPECT_TRUE(std::isfinite(odometry->pose.pose.position.x));
}

// Simulated time waited 0.2 s after each of them for the next command, and so for ever.
TEST_F(SimulatorTest, RefusedCommandsHoldNoSimulatedTime) {
  start({}, 8);
  const auto moving =
      driveUntil(twist(0.5), [](const Odometry& o) { return o.twist.twist.linear.x > 0.4; });
  ASSERT_TRUE(moving);
  const auto stopped = driveUntil(twist(std::numeric_limits<double>::quiet_NaN()),
                                  [](const Odometry& o) { return o.twist.twist.linear.x == 0.0; });
  ASSERT_TRUE(stopped) << "the vehicle has no command any more";
  EXPECT_GT(stopped->header.stamp, moving->header.stamp);
}

TEST_F(SimulatorTest, AReconfigurationThatContradictsItselfIsReverted) {
  start({});
  dynamic_reconfigure::Reconfigure call;
  dynamic_reconfigure::DoubleParameter timeout;
  timeout.name = "cmd_vel_timeout";
  timeout.value = 0.02;
  dynamic_reconfigure::DoubleParameter step;
  step.name = "time_step";
  step.value = 0.1;
  call.request.config.doubles = {timeout, step};
  ASSERT_TRUE(ros::service::call("/simulator/set_parameters", call));
  double answered = 0.0;
  ASSERT_TRUE(dynamic_reconfigure::ConfigTools::getParameter(call.response.config,
                                                             "cmd_vel_timeout", answered));
  EXPECT_EQ(answered, 0.5);
}

TEST(Simulator, ParametersThatCannotBeUsedEndItBeforeItStarts) {
  Process limits("simulator", {"_max_surge_speed:=-1.0"});
  ASSERT_TRUE(limits.waitForExit());
  EXPECT_EQ(limits.exitCode(), 1);
  Process type("simulator", {"_time_step:=short"});
  ASSERT_TRUE(type.waitForExit());
  EXPECT_EQ(type.exitCode(), 1);
  Process contradiction("simulator", {"_publish_clock:=false", "_real_time_factor:=2.0"});
  ASSERT_TRUE(contradiction.waitForExit());
  EXPECT_EQ(contradiction.exitCode(), 1);
}

// At a fiftieth of real time a tick is much less than a step.
TEST(Simulator, SimulatedTimeGoesOnHoweverSlowly) {
  ros::NodeHandle nh;
  ros::param::del("/simulator");
  Latest<rosgraph_msgs::Clock> clock(nh, "/clock");
  Process simulator("simulator", {"_real_time_factor:=0.02"});
  EXPECT_TRUE(clock.waitForMoreThan(1)) << "no more than one /clock has come";
}

TEST(Simulator, RunsAsANodelet) {
  ros::NodeHandle nh;
  Latest<Odometry> odom(nh, "odom");
  Process manager(
      test::nodeletCommand({"standalone", "grid_path_planner/simulator", "_real_time_factor:=10"}));
  EXPECT_TRUE(odom.waitForMoreThan(0));
}

}  // namespace
}  // namespace grid_path_planner::nodes
