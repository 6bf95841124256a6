// Whatever happens to navigate_path or around it, the vehicle stops.
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

#include <algorithm>
#include <optional>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/master/xmlrpc_call.h"
#include "ros/support/nodelet_command.h"
#include "ros/support/raw_subscriber.h"
#include "ros/support/still_fixture.h"
#include "support/ascii_map.h"

namespace grid_path_planner::nodes {
namespace {

using test::isZero;
using test::Latest;
using test::pathOf;
using test::Process;
using test::StillWorld;

class NavigateStops : public test::StillTest {
 protected:
  void driveIn(StillWorld&) { drive(); }
  // A row of cells of 1 m, long enough for a test that stalls; occupied at x = 20, or not.
  static std::string row(bool free) {
    std::string cells(30, '.');
    if (!free) cells[20] = '#';
    return cells;
  }
};

// A vehicle whose commander dies stops.
TEST_F(NavigateStops, WhenItIsKilled) {
  startSimulator({}, 2);  // "in transit" is 0.35 s of the wall
  startNavigate();
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(moves());
  navigate_->signal(SIGKILL);
  ASSERT_TRUE(navigate_->waitForExit());
  const ros::Time killed = odom_.all().back().header.stamp;
  const auto stands = [](const nav_msgs::Odometry& o) {
    return o.twist.twist.linear.x == 0.0 && o.twist.twist.linear.y == 0.0;
  };
  const std::size_t seen = odom_.count();
  ASSERT_TRUE(odom_.waitFor(seen, stands));
  const auto all = odom_.all();
  const auto stopped =
      std::find_if(all.begin() + static_cast<std::ptrdiff_t>(seen), all.end(), stands);
  EXPECT_LT((stopped->header.stamp - killed).toSec(), 0.5 + 0.8 + 0.7)
      << "timeout, braking, and messages in transit";
  EXPECT_TRUE(staysStill());
}

TEST_F(NavigateStops, OnSigint) {
  StillWorld world(100.0);
  driveIn(world);
  navigate_->signal(SIGINT);
  ASSERT_TRUE(navigate_->waitForExit());
  EXPECT_EQ(navigate_->exitCode(), 0);
  EXPECT_TRUE(lastCommandIsZero());
}

// roscpp breaks when it is shut down while publishers and services are made, now and then: the node
// died of a SIGTRAP where roslaunch was interrupted at once.
TEST_F(NavigateStops, OrderlyWhenAskedToWhileItComesUp) {
  const auto registered = [] {
    ros::V_string nodes;
    ros::master::getNodes(nodes);
    return std::count(nodes.begin(), nodes.end(), "/navigate_path") > 0;
  };
  for (int delay_ms = 0; delay_ms < 80; delay_ms += 10) {
    Process node("navigate_path", {});
    ASSERT_TRUE(test::waitFor(registered));
    ros::WallDuration(0.001 * delay_ms).sleep();
    node.signal(SIGTERM);
    ASSERT_TRUE(node.waitForExit());
    EXPECT_EQ(node.exitCode(), 0) << delay_ms << " ms: " << node.output();
    // Where the master keeps it waiting, it ends without giving its names back.
    ASSERT_TRUE(test::waitFor([&] {
      if (node.hasSaid("without giving its names back"))
        test::KilledNode("/navigate_path").forget();
      return !registered();
    }));
  }
}

// The master may tell who listens of the second's cmd_vel before it tells the first to end: roscpp's subscriber drops the
// link to the first then, and its zero is lost, as once in some fifty runs of CI. This one keeps it.
TEST_F(NavigateStops, WhenASecondNodeTakesItsName) {
  StillWorld world(100.0);
  driveIn(world);
  const auto uri = uriOfNode("/navigate_path", 10.0);
  ASSERT_TRUE(uri);
  test::RawSubscriber listener(*uri, "/cmd_vel");
  Process second("navigate_path", {});
  ASSERT_TRUE(navigate_->waitForExit()) << "the first ends";
  EXPECT_EQ(navigate_->exitCode(), 0);
  EXPECT_TRUE(navigate_->says("navigate_path ends: "));
  EXPECT_TRUE(navigate_->says("new node registered with same name")) << "and says why";
  std::optional<geometry_msgs::Twist> last;
  while (const auto next = listener.next<geometry_msgs::Twist>()) last = next;
  ASSERT_TRUE(last);
  EXPECT_TRUE(isZero(*last));
  EXPECT_TRUE(second.running());
}

TEST_F(NavigateStops, OnStaleTfAndGoesOnWhenItIsBack) {
  StillWorld world(100.0);
  driveIn(world);
  world.publishTf(false);
  EXPECT_TRUE(lastCommandIsZero());
  world.publishTf(true);
  EXPECT_TRUE(isDriving());
}

TEST_F(NavigateStops, AndDiagnosticsSayWhy) {
  StillWorld world(100.0);
  driveIn(world);
  EXPECT_TRUE(reports(diagnostic_msgs::DiagnosticStatus::OK, "driving"));
  world.publishTf(false);
  EXPECT_TRUE(reports(diagnostic_msgs::DiagnosticStatus::WARN, "blocked: the pose of base_link"));
  world.jumpTo(10.0);
  EXPECT_TRUE(reports(diagnostic_msgs::DiagnosticStatus::OK, "cancelled: time went back"));
}

TEST_F(NavigateStops, WhenTimeGoesBackAndDrivesTheNextPath) {
  StillWorld world(100.0);
  driveIn(world);
  world.jumpTo(10.0);
  EXPECT_TRUE(lastCommandIsZero());
  const std::size_t seen = velocity_.count();
  ASSERT_TRUE(test::waitFor([&] { return world.time() > 15.0; }));
  EXPECT_LE(velocity_.count(), seen + 5) << "the drive is over";
  ASSERT_TRUE(test::waitFor([&] { return ros::Time::now().toSec() < 50.0; }));
  publishPath(pathOf({{0, 0}, {0, 50}}));
  EXPECT_TRUE(isDriving());
}

TEST_F(NavigateStops, UntilThereIsAClock) {
  startNavigate({}, false);
  EXPECT_TRUE(navigate_->says("no /clock has come yet"));
  StillWorld world(100.0);
  ASSERT_TRUE(test::waitFor([&] { return paths_.getNumSubscribers() > 0; }));
  publishPath(pathOf({{0, 0}, {50, 0}}));
  EXPECT_TRUE(isDriving());
}

TEST_F(NavigateStops, BeforeOccupiedCellsAndGoesOnWhenTheyAreFree) {
  ros::Publisher maps = nh_.advertise<nav_msgs::OccupancyGrid>("projected_map", 1, true);
  const auto publishMap = [&](const std::vector<std::string>& lines) {
    maps.publish(occupancyToMessage(test::AsciiMap(lines).map, "/map", ros::Time::now()));
  };
  startSimulator({"_initial_x:=0.5", "_initial_y:=0.5"});
  publishMap({row(false)});
  startNavigate({"_check_map:=true"});
  publishPath(pathOf({{0.5, 0.5}, {25.5, 0.5}}));
  ASSERT_TRUE(moves());
  EXPECT_TRUE(staysStill());
  EXPECT_GT(pose().position.x(), 17.2) << "lookahead 2 m";
  EXPECT_LT(pose().position.x(), 20.0) << "braking takes longer where the machine has other work";
  publishMap({row(true)});
  EXPECT_TRUE(arrivesAt(25.5, 0.5));
}

// A map that is sent once and then in pieces is watched like one that is sent whole, also where ROS
// time has jumped back since the map was stamped (a bag that loops).
TEST_F(NavigateStops, BeforeCellsThatAnUpdateOfTheMapOccupies) {
  ros::Publisher maps = nh_.advertise<nav_msgs::OccupancyGrid>("projected_map", 1, true);
  ros::Publisher updates =
      nh_.advertise<map_msgs::OccupancyGridUpdate>("projected_map_updates", 1, true);
  maps.publish(occupancyToMessage(test::AsciiMap({row(true)}).map, "map", ros::Time(1e6)));
  startSimulator({"_initial_x:=0.5", "_initial_y:=0.5"});
  startNavigate({"_check_map:=true"});
  publishPath(pathOf({{0.5, 0.5}, {25.5, 0.5}}));
  ASSERT_TRUE(moves());
  map_msgs::OccupancyGridUpdate update;
  update.header.frame_id = "map";
  update.header.stamp = ros::Time::now();
  update.x = 20;
  update.width = update.height = 1;
  update.data = {100};
  updates.publish(update);
  EXPECT_TRUE(staysStill());
  EXPECT_LT(pose().position.x(), 20.0);
}

TEST_F(NavigateStops, RunsAsANodeletAndStopsWhenItIsUnloaded) {
  StillWorld world(100.0);
  Process manager(test::nodeletCommand({"manager", "__name:=manager"}));
  ASSERT_TRUE(test::waitFor([] { return ros::service::exists("/manager/load_nodelet", false); }));
  Process loader({"rosrun", "nodelet", "nodelet", "load", "grid_path_planner/navigate_path",
                  "manager", "__name:=navigate_path", "_check_map:=false"});
  ASSERT_TRUE(test::waitFor([&] { return paths_.getNumSubscribers() > 0; }));
  publishPath(pathOf({{0, 0}, {50, 0}}));
  ASSERT_TRUE(isDriving());
  loader.signal(SIGINT);  // unloads it
  EXPECT_TRUE(lastCommandIsZero());
  EXPECT_TRUE(loader.waitForExit());
  EXPECT_TRUE(manager.running());
}

}  // namespace
}  // namespace grid_path_planner::nodes
