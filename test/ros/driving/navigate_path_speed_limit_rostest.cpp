// navigate_path drives no faster than the map of speed limits allows, and by use_speed_limit not without one.
#include <nav_msgs/OccupancyGrid.h>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/navigate_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using grid::GridGeometry;
using grid::OccupancyGrid;
using test::pathOf;
using test::waitFor;

// It waits for commands, so that the drive does not depend on how busy the machine is.
const std::vector<std::string> kObedient = {"_cmd_vel_timeout:=0.1"};
// Else it goes on by a pose of up to 3 s of the simulation ago, and is in the zone before it knows; 0.1 s are 0.08 m.
const std::string kStandsWithoutPose = "_tf_timeout:=0.1";

class SpeedLimitedDrive : public test::NavigateTest {
 protected:
  // Percent in the metres from x = 3 to 6.
  void publishLimit(std::int8_t percent) {
    OccupancyGrid limits(GridGeometry(12, 4, 1.0, {0.0, -2.0, 0.0}), 0);
    for (int row = 0; row < 4; ++row)
      for (int column = 3; column < 6; ++column) limits.row(row)[column] = percent;
    limits_.publish(occupancyToMessage(limits, "map", ros::Time::now()));
  }
  double fastestBetween(double from, double to) const {
    double fastest = 0.0;
    for (const nav_msgs::Odometry& odometry : odom_.all()) {
      const double x = odometry.pose.pose.position.x;
      const geometry_msgs::Vector3& v = odometry.twist.twist.linear;
      if (x >= from && x <= to) fastest = std::max(fastest, std::hypot(v.x, v.y));
    }
    return fastest;
  }

  ros::Publisher limits_ = nh_.advertise<nav_msgs::OccupancyGrid>("speed_limit", 1, true);
};

TEST_F(SpeedLimitedDrive, IsSlowInTheZoneAndFastBeforeAndBehindIt) {
  startSimulator(kObedient);
  startNavigate({kStandsWithoutPose});
  ASSERT_TRUE(waitFor([&] { return limits_.getNumSubscribers() > 0; }));
  publishLimit(25);
  publishPath(pathOf({{0, 0}, {9, 0}}));
  ASSERT_TRUE(arrivesAt(9, 0));
  EXPECT_GT(fastestBetween(0.0, 2.0), 0.6);
  EXPECT_LT(fastestBetween(3.2, 6.0), 0.2 * 1.1) << "25 % of 0.8 m/s, and what the vehicle lags";
  EXPECT_GT(fastestBetween(3.2, 6.0), 0.15);
  EXPECT_GT(fastestBetween(6.5, 8.5), 0.5);
}

TEST_F(SpeedLimitedDrive, WaitsForTheMapWhereItIsAskedTo) {
  startSimulator(kObedient);
  startNavigate({"_use_speed_limit:=true", "_no_progress_timeout:=0"});
  publishPath(pathOf({{0, 0}, {9, 0}}));
  EXPECT_TRUE(navigate_->says("no map of speed limits has come on speed_limit yet"));
  EXPECT_TRUE(staysStill(2.0));
  publishLimit(0);
  EXPECT_TRUE(moves());
}

// What was seen: a mask of a node that had been dead for minutes was heeded for ever; the limits that it would have sent
// since, for the zone that is closed now, nobody knew.
TEST_F(SpeedLimitedDrive, HoldsWhileTheNodeThatSentTheMapIsDead) {
  const test::TemporaryFolder folder;
  const std::vector<std::string> latched = {
      "--filename", folder.write("zone.map", "type octile\nheight 1\nwidth 2\nmap\n..\n"),
      "_topic:=speed_limit"};
  auto zones = std::make_unique<test::Process>("map_publisher", latched);
  startSimulator(kObedient);
  startNavigate({"_use_speed_limit:=true", "_no_progress_timeout:=0"});
  publishPath(pathOf({{0, 0}, {900, 0}}));
  ASSERT_TRUE(moves());
  zones->signal(SIGKILL);
  EXPECT_TRUE(
      navigate_->says("the map of speed limits on /speed_limit is not kept up: "
                      "/map_publisher has not answered for"));
  EXPECT_TRUE(staysStill(2.0));
  zones = std::make_unique<test::Process>("map_publisher", latched);
  EXPECT_TRUE(moves());
}

// What cannot be read as limits leaves those before in force.
TEST_F(SpeedLimitedDrive, KeepsTheMapBeforeOneThatIsRefused) {
  startSimulator(kObedient);
  startNavigate({kStandsWithoutPose, "_use_speed_limit:=true", "_no_progress_timeout:=0"});
  ASSERT_TRUE(waitFor([&] { return limits_.getNumSubscribers() > 0; }));
  publishPath(pathOf({{0, 0}, {0.5, 0}}));
  EXPECT_TRUE(navigate_->says("no map of speed limits has come on speed_limit yet"));
  publishLimit(25);
  ASSERT_TRUE(arrivesAt(0.5, 0)) << "the map is in force";
  publishLimit(125);
  EXPECT_TRUE(navigate_->says("/speed_limit is refused"));
  publishPath(pathOf({{0, 0}, {9, 0}}));
  ASSERT_TRUE(waitFor([&] { return pose().position.x() > 5.5; }));
  EXPECT_LT(fastestBetween(3.2, 5.5), 0.2 * 1.1);
}

}  // namespace
}  // namespace grid_path_planner::nodes
