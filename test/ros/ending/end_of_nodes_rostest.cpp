// Every node ends after SIGINT and SIGTERM, also while it works, which it stops. How long it takes at most is printed: only a
// quiet machine says something by it.
#include <nav_msgs/GetPlan.h>
#include <ros/network.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <thread>

#include "ros/support/known_nodes.h"
#include "ros/support/own_master.h"
#include "ros/support/planner_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::poseAt;
using test::Process;
using test::waitFor;

struct Node {
  const char* name;
  std::vector<std::string> arguments;
};

std::vector<Node> everyNode() {
  return {{"path_planner", {}},
          {"map_publisher", {"--filename", GPP_TEST_DATA "/projected_map.bag"}},
          {"map_layers", {"--zones-file", GPP_TEST_DATA "/zones.yaml"}},
          {"navigate_path", {}},
          {"local_planner", {}},
          {"marker_localizer", {"--layout", GPP_TEST_DATA "/two_markers.yaml"}},
          {"vehicle_localizer", {}},
          {"go_to_pose", {}},
          {"teleop_joy", {}},
          {"projected_map", {"_autosave_period:=0"}},
          {"simulator", {}}};
}

TEST(EndOfNodes, EveryNodeOfThePackageIsTested) {
  std::set<std::string> tested;
  for (const Node& node : everyNode()) tested.insert(node.name);
  EXPECT_EQ(tested, test::knownNodes());
}

TEST(EndOfNodes, BySignal) {
  double longest = 0.0;
  for (const Node& node : everyNode())
    for (const int number : {SIGINT, SIGTERM}) {
      Process process(node.name, node.arguments);
      ASSERT_TRUE(process.says(" runs")) << node.name;
      longest = std::max(longest, process.end(number));
      EXPECT_EQ(process.exitCode(), 0) << node.name;
    }
  std::printf("the longest end took %.2f s\n", longest);
}

// As rosnode kill and the master do, which may give a reason. By the code, one with the reason "" was not heard.
TEST(EndOfNodes, ByARequestForShutdown) {
  for (const std::string reason : {"", "a new node has its name"}) {
    Process process("simulator", {});
    ASSERT_TRUE(process.says(" runs"));
    XmlRpc::XmlRpcValue name, uri, request, response;
    name[0] = "/end_of_nodes";
    name[1] = "/simulator";
    XmlRpc::XmlRpcValue answer;
    ASSERT_TRUE(ros::master::execute("lookupNode", name, answer, uri, false));
    std::string host;
    std::uint32_t port = 0;
    ASSERT_TRUE(ros::network::splitURI(static_cast<std::string&>(uri), host, port));
    XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
    request[0] = "/end_of_nodes";
    request[1] = reason;
    ASSERT_TRUE(client.execute("shutdown", request, response));
    EXPECT_TRUE(process.waitForExit());
    EXPECT_EQ(process.exitCode(), 0);
    EXPECT_TRUE(process.hasSaid("ends: " + (reason.empty() ? "asked by the master" : reason)));
  }
}

// One that takes connections and is stopped, or that has too much to do: roscpp waits for its answer to every topic
// that is given back. In CI a planner with thirty of them took longer than ten seconds.
TEST(EndOfNodes, WhileTheMasterAnswersNobody) {
  const test::OwnMaster master;
  std::vector<std::unique_ptr<Process>> processes;
  for (Node node : everyNode()) {  // each with a vehicle of its own
    node.arguments.insert(node.arguments.end(), {"__ns:=/" + std::string(node.name), "/tf:=tf"});
    processes.push_back(master.start(node.name, node.arguments));
  }
  for (const auto& process : processes) ASSERT_TRUE(process->says(" runs"));
  master.signal(SIGSTOP);
  for (const auto& process : processes) process->signal(SIGTERM);
  for (const auto& process : processes) {
    EXPECT_TRUE(process->waitForExit());
    EXPECT_EQ(process->exitCode(), 0);
    EXPECT_TRUE(process->hasSaid("does not answer"));
  }
}

// `rosrun grid_path_planner projected_map missing.bt` ended the projected_map that ran, and then itself:
// the master ends the older of two nodes of one name.
TEST(EndOfNodes, ASecondOneWhoseFileCannotBeReadDoesNotEndTheFirst) {
  const test::TemporaryFolder folder;
  const std::string damaged = folder.write("damaged.yaml", "waypoints:\n  - position: {x: 1}\n");
  const std::vector<std::vector<std::string>> pairs = {
      {"projected_map", folder.path("missing.bt"), "missing.bt: cannot be read"},
      {"map_publisher", folder.path("missing.yaml"), "missing.yaml: cannot be read"},
      {"navigate_path", "--config-filename=" + damaged, "damaged.yaml:2"}};
  for (const auto& pair : pairs) {
    std::vector<std::string> arguments;
    if (pair[0] == "map_publisher") arguments = {GPP_TEST_DATA "/projected_map.bag"};
    Process first(pair[0], arguments);
    ASSERT_TRUE(first.says(" runs")) << pair[0];
    Process second(pair[0], {pair[1]});
    ASSERT_TRUE(second.waitForExit()) << pair[0];
    EXPECT_EQ(second.exitCode(), 1) << pair[0];
    EXPECT_NE(second.output().find(pair[2]), std::string::npos) << second.output();
    EXPECT_TRUE(first.running()) << pair[0];
    EXPECT_EQ(first.output().find("ends"), std::string::npos) << first.output();
  }
}

class EndOfPlanner : public test::PlannerTest {};

// A plan without a time limit, and clients that wait for its answer: it is given up, not finished.
TEST_F(EndOfPlanner, BySignalWhileItPlans) {
  constexpr int kSide = 3000;
  grid::OccupancyGrid map(grid::GridGeometry(kSide, kSide, 1.0));
  for (std::int8_t& value : map.values()) value = 0;
  for (const int number : {SIGINT, SIGTERM}) {
    startPlanner({"_planner:=dijkstra", "_timeout:=0"});
    publishMap(map);
    double begin = planner_->processorSeconds();
    makePlan(poseAt(0.5, 0.5), poseAt(kSide - 0.5, kSide - 0.5));
    const double whole_plan = planner_->processorSeconds() - begin;
    begin += whole_plan;
    std::vector<std::thread> clients;
    for (int i = 0; i < 4; ++i)
      clients.emplace_back([] {
        nav_msgs::GetPlan call;
        call.request.start = poseAt(0.5, 0.5);
        call.request.goal = poseAt(kSide - 0.5, kSide - 0.5);
        while (ros::service::call("/path_planner/make_plan", call)) {
        }
      });
    goals_.publish(poseAt(kSide - 0.5, kSide - 0.5));
    ASSERT_TRUE(waitFor([&] { return planner_->processorSeconds() > begin + 0.1 * whole_plan; }));
    begin = planner_->processorSeconds();
    planner_->end(number);
    EXPECT_LT(planner_->processorSeconds() - begin, 0.5 * whole_plan);
    EXPECT_EQ(planner_->exitCode(), 0);
    for (std::thread& client : clients) client.join();
    ASSERT_TRUE(waitFor([this] { return maps_.getNumSubscribers() == 0; }));
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
