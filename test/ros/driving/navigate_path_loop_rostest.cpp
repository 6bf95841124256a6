// The control loop waits for nobody.
//
// What was seen before: everything ran in one thread. A waypoint file of 1,000, 5,000 or 20,000
// waypoints silenced cmd_vel for 0.2, 2 and 5.7 s; a log that nobody read, for ever; a vehicle whose
// /clock stopped drove on; and one whose roscore was restarted could not be cancelled any more.
#include <actionlib/client/simple_action_client.h>
#include <std_msgs/Bool.h>

#include <cstdio>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/common/master/xmlrpc_call.h"
#include "ros/support/links.h"
#include "ros/support/own_master.h"
#include "ros/support/still_fixture.h"
#include "ros/support/unread_log.h"

namespace grid_path_planner::nodes {
namespace {

using path::Path;
using test::isZero;
using test::OwnMaster;
using test::pathOf;
using test::Process;
using test::StillWorld;
using XmlRpc::XmlRpcValue;

struct TemporaryName {
  explicit TemporaryName(const std::string& end)
      : name(testing::TempDir() + "navigate_loop_" + std::to_string(::getpid()) + end) {}
  ~TemporaryName() { std::remove(name.c_str()); }
  const std::string name;
};

class NavigateLoop : public test::StillTest {
 protected:
  std::size_t timesSaid(const std::string& text) const {
    const std::string said = navigate_->output();
    std::size_t times = 0;
    for (std::size_t at = said.find(text); at != std::string::npos; at = said.find(text, at + 1))
      ++times;
    return times;
  }
};

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

TEST_F(NavigateLoop, AWaypointFileIsReadElsewhere) {
  StillWorld world(100.0);
  const TemporaryName file(".yaml");
  Path path;
  for (int i = 0; i < 20000; ++i) path.poses.push_back({{0.01 * i, 0.1 * (i % 7), 0}, 0.0});
  path::writeWaypointFile(file.name, path);
  drive();
  actionlib::SimpleActionClient<NavigatePathAction> client("navigate_path", false);
  ASSERT_TRUE(test::waitFor([&] { return client.isServerConnected(); }));
  NavigatePathGoal goal;
  goal.filename = file.name;
  // A loaded machine takes some, not all, and of one reading perhaps all.
  bool has_its_share = false;
  for (std::size_t readings = 1; readings <= 5 && !has_its_share; ++readings) {
    const auto begin = ros::WallTime::now();
    const std::size_t before = velocity_.count();
    client.sendGoal(goal);
    ASSERT_TRUE(test::waitFor([&] { return timesSaid("of 20000 waypoints") == readings; }));
    const double reading = (ros::WallTime::now() - begin).toSec();
    const auto commands = static_cast<double>(velocity_.count() - before);
    std::printf("20000 waypoints: %.0f ms to read, %.0f commands meanwhile\n", 1000.0 * reading,
                commands);
    has_its_share = commands > 0.05 * kControlRate * reading;
  }
  EXPECT_TRUE(has_its_share);
}

TEST_F(NavigateLoop, AGoalWhoseFileIsReadCanBeCancelled) {
  StillWorld world(100.0);
  const TemporaryName file(".yaml");
  Path path;
  for (int i = 0; i < 20000; ++i) path.poses.push_back({{0.01 * i, 0, 0}, 0.0});
  path::writeWaypointFile(file.name, path);
  startNavigate();
  actionlib::SimpleActionClient<NavigatePathAction> client("navigate_path", false);
  ASSERT_TRUE(test::waitFor([&] { return client.isServerConnected(); }));
  NavigatePathGoal goal;
  goal.filename = file.name;
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

// A master of its own, which the test may kill; its nodes are seen by what they print.
class NavigateMaster : public testing::Test {
 protected:
  NavigateMaster() {
    useSimulatedTime();
    path::writeWaypointFile(file_.name, pathOf({{0, 0}, {500, 0}}));
  }

  void useSimulatedTime() {
    callXmlRpc(uri_, "setParam",
               {XmlRpcValue("/test"), XmlRpcValue("/use_sim_time"), XmlRpcValue(true)}, 1.0);
  }
  void drive(const std::string& file, const std::string& timeout) {
    simulator_ = master_.start("simulator", {"_real_time_factor:=4"});
    navigate_ = master_.start("navigate_path", {"_config_filename:=" + file, "_check_map:=false",
                                                "_tf_timeout:=3.0", "_master_timeout:=" + timeout});
    ASSERT_TRUE(navigate_->says("Drives the waypoints of"));
    ASSERT_TRUE(test::waitFor([&] { return knows(2, "/navigate_path/cancel", "/navigate_path"); }));
  }
  // Of publishers (0), subscribers (1) or services (2).
  bool knows(int kind, const std::string& name, const std::string& node) {
    auto state = callXmlRpc(uri_, "getSystemState", {XmlRpcValue("/test")}, 1.0);
    for (int i = 0; state && i < (*state)[kind].size(); ++i) {
      XmlRpcValue& entry = (*state)[kind][i];
      for (int n = 0; static_cast<std::string&>(entry[0]) == name && n < entry[1].size(); ++n)
        if (static_cast<std::string&>(entry[1][n]) == node) return true;
    }
    return false;
  }
  bool knowsAll() {
    return knows(0, "/cmd_vel", "/navigate_path") && knows(1, "/cmd_vel", "/simulator") &&
           knows(1, "/tf", "/navigate_path") && knows(0, "/clock", "/simulator") &&
           knows(1, "/path", "/navigate_path") == false &&
           knows(2, "/navigate_path/cancel", "/navigate_path") &&
           knows(1, "/navigate_path/goal", "/navigate_path") && knows(0, "/odom", "/simulator");
  }

  // The last line of `rostopic echo -p /cmd_vel`, without its time.
  static bool endsWithZero(const std::string& output) {
    const std::string lines = output.substr(0, output.rfind('\n'));
    const std::string last = lines.substr(lines.rfind('\n') + 1);
    return last.find(",0.0,0.0,0.0,0.0,0.0,0.0") != std::string::npos;
  }

  // Whether the node has a connection from a publisher of the topic.
  bool hears(const std::string& node, const std::string& topic) {
    auto uri = callXmlRpc(uri_, "lookupNode", {XmlRpcValue("/test"), XmlRpcValue(node)}, 1.0);
    return uri && test::linksOf(std::string(*uri), topic, "i") > 0;
  }

  const TemporaryName file_{".yaml"};
  OwnMaster master_;
  const std::string uri_ = master_.uri();
  std::unique_ptr<Process> simulator_, navigate_;
};

TEST_F(NavigateMaster, OneThatIsRestartedKnowsAllNamesAgain) {
  drive(file_.name, "3");
  ASSERT_TRUE(test::waitFor([&] { return knowsAll(); }));
  ros::WallDuration(3.0).sleep();  // its nodes have asked it for their services, once a second
  master_.kill();
  EXPECT_TRUE(navigate_->says("the ROS master has not answered for longer than master_timeout"));
  const auto back = ros::WallTime::now();
  master_.run();
  useSimulatedTime();
  EXPECT_TRUE(test::waitFor([&] { return knowsAll(); }));
  std::printf("all names again after %.1f s\n", (ros::WallTime::now() - back).toSec());
  EXPECT_TRUE(navigate_->says("goes on"));
}

TEST_F(NavigateMaster, TheDriveGoesOnWithoutOne) {
  const TemporaryName file("_short.yaml");
  path::writeWaypointFile(file.name, pathOf({{0, 0}, {8, 0}}));
  drive(file.name, "0");
  ASSERT_TRUE(test::waitFor([&] {
    return hears("/simulator", "/cmd_vel") && hears("/navigate_path", "/tf") &&
           hears("/navigate_path", "/clock");
  }));
  master_.kill();
  EXPECT_TRUE(navigate_->says("ARRIVED: "));
}

// Its destructor gave a topic back to the master before it cancelled the drive, and waited: the vehicle drove on.
TEST_F(NavigateMaster, ASignalStopsTheVehicleWhileItAnswersNobody) {
  drive(file_.name, "0");
  const auto commands = master_.run({"rostopic", "echo", "-p", "/cmd_vel"});
  ASSERT_TRUE(commands->says("field.linear.x"));
  ASSERT_TRUE(test::waitFor([&] { return !endsWithZero(commands->output()); }));
  master_.signal(SIGSTOP);
  navigate_->end(SIGTERM);
  EXPECT_EQ(navigate_->exitCode(), 0);
  EXPECT_TRUE(test::waitFor([&] { return endsWithZero(commands->output()); }));
  for (Process* left : {simulator_.get(), commands.get()}) left->signal(SIGKILL);
}

}  // namespace
}  // namespace grid_path_planner::nodes
