// A drive whose ROS master is killed, restarted or hangs.
//
// What was seen before: after a restart the vehicle drove on and could not be cancelled; a node that was told to end asked
// the master that hung before it stopped the vehicle.
#include <gtest/gtest.h>

#include <fstream>

#include "grid_path_planner/path/waypoint_file.h"
#include "ros/guard/master/xmlrpc_call.h"
#include "ros/support/links.h"
#include "ros/support/own_master.h"
#include "ros/support/still_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::OwnMaster;
using test::pathOf;
using test::Process;
using test::TemporaryFolder;
using XmlRpc::XmlRpcValue;

// A master of its own, which the test may kill; its nodes are seen by what they print.
class NavigateMaster : public testing::Test {
 protected:
  NavigateMaster() {
    useSimulatedTime();
    path::writeWaypointFile(file_, pathOf({{0, 0}, {500, 0}}));
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

  void expectGoesOnSaysSoAndStands(int signal) {
    drive(file_, "12");
    const auto commands = master_.run({"rostopic", "echo", "-p", "/cmd_vel"});
    const auto diagnostics = master_.run({"rostopic", "echo", "/diagnostics"});
    ASSERT_TRUE(commands->says("field.linear.x"));
    ASSERT_TRUE(diagnostics->says("nobody else commands the vehicle"));
    ASSERT_TRUE(test::waitFor([&] { return !endsWithZero(commands->output()); }));
    master_.signal(signal);
    EXPECT_TRUE(diagnostics->says("12 s after its last answer"));
    EXPECT_FALSE(endsWithZero(commands->output())) << "it goes on";
    EXPECT_TRUE(navigate_->says("the ROS master has not answered for longer than master_timeout"));
    EXPECT_TRUE(test::waitFor([&] { return endsWithZero(commands->output()); }));
    for (Process* left : {simulator_.get(), navigate_.get(), commands.get(), diagnostics.get()})
      left->signal(SIGKILL);
  }

  // Whether the node has a connection from a publisher of the topic.
  bool hears(const std::string& node, const std::string& topic) {
    auto uri = callXmlRpc(uri_, "lookupNode", {XmlRpcValue("/test"), XmlRpcValue(node)}, 1.0);
    return uri && test::linksOf(std::string(*uri), topic, "i") > 0;
  }

  const TemporaryFolder folder_{testing::TempDir()};
  const std::string file_ = folder_.path("route.yaml");
  OwnMaster master_;
  const std::string uri_ = master_.uri();
  std::unique_ptr<Process> simulator_, navigate_;
};

TEST_F(NavigateMaster, OneThatIsRestartedKnowsAllNamesAgain) {
  drive(file_, "3");
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

// What did not reach the master in the first second was lost for good: it knew the node again, and nobody told it the rest.
TEST_F(NavigateMaster, NamesThatTheMasterDidNotHearAreToldAgain) {
  const std::string lossy = folder_.path("lossy");
  master_.stayBehind(lossy);
  drive(file_, "0");
  ASSERT_TRUE(test::waitFor([&] { return knowsAll(); }));
  ros::WallDuration(3.0).sleep();  // as above
  master_.kill();
  std::ofstream(lossy).put(0);
  master_.run();
  useSimulatedTime();
  EXPECT_TRUE(test::waitFor([&] { return knowsAll(); }));
}

TEST_F(NavigateMaster, TheDriveGoesOnWithoutOne) {
  const std::string file = folder_.path("short.yaml");
  path::writeWaypointFile(file, pathOf({{0, 0}, {8, 0}}));
  drive(file, "0");
  ASSERT_TRUE(test::waitFor([&] {
    return hears("/simulator", "/cmd_vel") && hears("/navigate_path", "/tf") &&
           hears("/navigate_path", "/clock");
  }));
  master_.kill();
  EXPECT_TRUE(navigate_->says("ARRIVED: "));
}

// The diagnostics did not say when it stands. every_commander_master has all that command.
TEST_F(NavigateMaster, ADriveWithoutOneGoesOnSaysSoAndStands) {
  expectGoesOnSaysSoAndStands(SIGKILL);
}

TEST_F(NavigateMaster, ADriveWhoseMasterHangsGoesOnSaysSoAndStands) {
  expectGoesOnSaysSoAndStands(SIGSTOP);
}

// Its destructor gave a topic back to the master before it cancelled the drive, and waited: the vehicle drove on.
TEST_F(NavigateMaster, ASignalStopsTheVehicleWhileItAnswersNobody) {
  drive(file_, "0");
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
