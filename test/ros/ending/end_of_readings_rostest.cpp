// A node that reads a large file ends within 2 s of SIGTERM all the same, and does not wait for the end
// of the file: projected_map and navigate_path did, for up to read_time_limit, half a minute.
#include <actionlib/client/simple_action_client.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <sstream>
#include <thread>

#include "grid_path_planner/NavigatePathAction.h"
#include "ros/support/process.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::Process;
using test::waitFor;

// Waypoints not as the package writes them: each takes some 100 us.
std::string foreignWaypoints(int count) {
  std::ostringstream text;
  text << "waypoints:\n";
  for (int i = 0; i < count; ++i)
    text << "- {position: {x: " << i << ", y: 2, z: 0}, orientation: {z: 0, w: 1}}\n";
  return text.str();
}

// The nodes of a tree that is `depth` levels deep everywhere, as in a .ot file.
std::string nodesOfFullTree(int depth) {
  const std::string log_odds("\x9a\x99\x59\x3f", 4);
  if (depth == 0) return log_odds + '\0';
  const std::string child = nodesOfFullTree(depth - 1);
  std::string nodes = log_odds + '\xff';
  nodes.reserve(nodes.size() + 8 * child.size());
  for (int i = 0; i < 8; ++i) nodes += child;
  return nodes;
}

// With 19 million nodes of 5 bytes.
std::string largeTree(const std::string& comments = "") {
  const std::string nodes = nodesOfFullTree(8);
  return "# Octomap OcTree file\n" + comments + "id OcTree\nsize " +
         std::to_string(nodes.size() / 5) + "\nres 0.1\ndata\n" + nodes;
}

class EndOfReadings : public testing::Test {
 protected:
  EndOfReadings() { ros::param::del("/projected_map"); }  // what was set before

  static bool takes(const Process& node, std::size_t megabytes) {
    return waitFor([&] { return node.peakMemory() > megabytes << 20; });
  }
  static bool runs(Process& node) { return node.says(" runs"); }
  // Once it is seen to read: file and what is made of it take far more in the end.
  static void endWhileItReads(Process& node) {
    EXPECT_TRUE(takes(node, 200));
    node.end(SIGTERM);
    EXPECT_EQ(node.exitCode(), 0);
    EXPECT_TRUE(node.says("ends: signal 15"));
  }
  // A node that reads before it is up.
  static void endWhileItStarts(Process& node) {
    endWhileItReads(node);
    EXPECT_EQ(node.output().find(" runs"), std::string::npos) << "it read to the end";
  }

  const test::TemporaryFolder folder_;
};

TEST_F(EndOfReadings, OfAnOctreeAtTheStart) {
  Process node("projected_map",
               {"--filename", folder_.write("large.ot", largeTree()), "_autosave_period:=0"});
  endWhileItStarts(node);
}

TEST_F(EndOfReadings, OfAnOctreeThatAParameterNames) {
  folder_.write("large.ot", largeTree());
  Process node("projected_map", {"--load-folder", folder_.path("."), "_autosave_period:=0"});
  ASSERT_TRUE(runs(node));
  std::thread client([] {
    dynamic_reconfigure::Reconfigure call;
    call.request.config.strs.resize(1);
    call.request.config.strs[0].name = "filename";
    call.request.config.strs[0].value = "large.ot";
    ros::service::call("/projected_map/set_parameters", call);
  });
  endWhileItReads(node);
  client.join();
}

// What was kept is not lost by a node that ends before it has it.
TEST_F(EndOfReadings, OfTheMapThatWasKept) {
  const std::vector<std::string> arguments = {"--save-folder", folder_.path(".")};
  {
    Process node("projected_map", arguments);
    ASSERT_TRUE(runs(node));
  }
  ASSERT_EQ(folder_.names().size(), 1u) << "the map is kept";
  const std::string name = folder_.names().front();
  std::istringstream kept(test::contentOf(folder_.path(name)));
  std::string first, whose, newest;
  std::getline(kept, first);
  std::getline(kept, whose);
  std::getline(kept, newest);
  const std::string content = largeTree(whose + "\n" + newest + "\n");
  folder_.write(name, content);
  Process node("projected_map", arguments);
  ASSERT_TRUE(node.says("Begins with the map that was kept"));
  endWhileItStarts(node);
  EXPECT_TRUE(test::contentOf(folder_.path(name)) == content);
}

TEST_F(EndOfReadings, OfWaypointsAtTheStart) {
  Process node("navigate_path",
               {"--config-filename", folder_.write("large.yaml", foreignWaypoints(150000))});
  endWhileItStarts(node);
}

TEST_F(EndOfReadings, OfWaypointsThatAGoalNames) {
  folder_.write("large.yaml", foreignWaypoints(150000));
  Process node("navigate_path", {"--load-folder", folder_.path(".")});
  actionlib::SimpleActionClient<NavigatePathAction> client("navigate_path", true);
  ASSERT_TRUE(client.waitForServer(ros::Duration(20.0)));
  NavigatePathGoal goal;
  goal.filename = "large.yaml";
  client.sendGoal(goal);
  endWhileItReads(node);
}

}  // namespace
}  // namespace grid_path_planner::nodes
