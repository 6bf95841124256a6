// What nodes may take, and where there is less.
#include <std_srvs/Empty.h>

#include <random>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/manager_client.h"
#include "ros/support/map_listeners.h"
#include "ros/support/mapping_fixture.h"
#include "ros/support/nodelet_command.h"
#include "ros/support/planner_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using test::Process;
using test::waitFor;

int countOf(const std::string& what, const std::string& text) {
  int count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

// The command with so many KiB of address space.
std::vector<std::string> limitedTo(int kibibytes, const std::vector<std::string>& command) {
  std::vector<std::string> limited = {
      "sh", "-c", "ulimit -v " + std::to_string(kibibytes) + " && exec \"$@\"", "sh"};
  limited.insert(limited.end(), command.begin(), command.end());
  return limited;
}

std::vector<std::string> programOf(const std::string& node,
                                   const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {GPP_DEVEL "/lib/grid_path_planner/" + node};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

class MemoryLimits : public testing::Test {
 protected:
  MemoryLimits() {
    for (const char* node : {"/path_planner", "/projected_map", "/map_layers"})
      ros::param::del(node);
  }
};

// path_planner alone did.
TEST_F(MemoryLimits, AreToldOnceByEachNodeThatHasOne) {
  for (const auto& [node, what] :
       {std::pair{"path_planner", "Planning"}, {"projected_map", "The 3-D map"}}) {
    const std::string told = std::string(what) + " may take 500 MB (memory_limit)";
    Process process(node, {"_memory_limit:=500"});
    EXPECT_TRUE(process.says(told)) << node;
    ros::service::waitForService(std::string("/") + node + "/set_parameters", 20000);
    EXPECT_EQ(countOf("may take", process.output()), 1) << node;
    process.end(SIGINT);
    ros::param::del(std::string("/") + node);
    Process nodelet(test::nodeletCommand({"standalone", std::string("grid_path_planner/") + node,
                                          std::string("__name:=") + node, "_memory_limit:=500"}));
    EXPECT_TRUE(nodelet.says(told)) << node;
    nodelet.end(SIGINT);
    ros::param::del(std::string("/") + node);
  }
}

TEST_F(MemoryLimits, AreHalfOfWhatIsAvailableWhereNoneIsSet) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "shadow memory takes the address space that the limit is on";
#endif
  constexpr int kSpace = 2500000;  // KiB
  for (const auto& [node, what] :
       {std::pair{"path_planner", "Planning"}, {"projected_map", "The 3-D map"}}) {
    Process process(limitedTo(kSpace, programOf(node, {"_memory_limit:=0"})));
    ASSERT_TRUE(process.says("MB (memory_limit is 0: half of what was available at the start)"));
    const std::string output = process.output(), before = std::string(what) + " may take ";
    const std::size_t at = output.find(before);
    ASSERT_NE(at, std::string::npos) << output;
    const int megabytes = std::stoi(output.substr(at + before.size()));
    EXPECT_LE(megabytes, kSpace / 1000 * 1024 / 1000 / 2) << "of the address space, or less";
    EXPECT_GT(megabytes, 0);
    process.end(SIGINT);
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

grid::OccupancyGrid emptyMap(int side) {
  grid::OccupancyGrid map(grid::GridGeometry(side, side, 1.0));
  for (std::int8_t& value : map.values()) value = 0;
  return map;
}

TEST_F(MemoryLimits, MapLayersGoesOnAfterAMapThatDoesNotFit) {
  constexpr int kSide = 12000;  // cells; the map and what is made of it take 2.9 GB
  ros::NodeHandle nh;
  ros::Publisher maps = nh.advertise<nav_msgs::OccupancyGrid>("static_map", 1, true);
  const test::MapCopy copy(nh, "projected_map");
  Process node(limitedTo(1500000, programOf("map_layers", {"_use_scan:=false"})));
  ASSERT_TRUE(waitFor([&] { return copy.connected() && maps.getNumSubscribers() > 0; }));
  maps.publish(occupancyToMessage(emptyMap(kSide), "map", ros::Time::now()));
  EXPECT_TRUE(node.says("there is not enough memory"));
  EXPECT_TRUE(node.running());
  maps.publish(occupancyToMessage(emptyMap(10), "map", ros::Time::now()));
  EXPECT_TRUE(waitFor([&] { return copy.maps() > 0; }));
  EXPECT_EQ(copy.grid().width(), 10);
}

class NodeletMemory : public test::PlannerTest {};

// With everything that the manager has, if it were not caught.
TEST_F(NodeletMemory, AManagerOutlivesAPlanThatDoesNotFit) {
  constexpr int kSide = 9000;  // cells; the map fits, its costmaps and a search do not
  startPlanner(std::make_unique<Process>(limitedTo(
      1800000,
      test::nodeletCommand({"standalone", "grid_path_planner/path_planner", "__name:=path_planner",
                            "_planner:=dijkstra", "_timeout:=0", "_memory_limit:=1000000"}))));
  maps_.publish(occupancyToMessage(emptyMap(kSide), "map", ros::Time::now()));
  ASSERT_TRUE(waitFor([this] {
    makePlan(test::poseAt(0.5, 0.5), test::poseAt(kSide - 0.5, kSide - 0.5));
    return answer_.status != "NO_MAP";
  }));
  EXPECT_EQ(answer_.status, "INVALID_REQUEST") << answer_.message;
  EXPECT_NE(answer_.message.find("memory"), std::string::npos) << answer_.message;
  publishMap(emptyMap(10));
  makePlan(test::poseAt(0.5, 0.5), test::poseAt(9.5, 9.5));
  EXPECT_EQ(answer_.status, "FOUND") << answer_.message;
  EXPECT_TRUE(planner_->running());
}

class MappingMemory : public test::MappingTest {};

// Its own limit would hold it back before. A crash ended it; one cloud after the other for which there is no memory ends it in
// order now.
TEST_F(MappingMemory, ProjectedMapEndsInOrderAfterCloudsThatDoNotFit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> metres(-30.0F, 30.0F);
  node_ = std::make_unique<Process>(
      limitedTo(1300000, programOf("projected_map", {"_memory_limit:=1000000", "_resolution:=0.05",
                                                     "_publish_rate:=50", "_autosave_period:=0"})));
  ASSERT_TRUE(waitFor([this] { return clouds_.getNumSubscribers() > 0; }));
  EXPECT_TRUE(waitFor([&] {
    test::CloudPoints points(20000);
    for (Eigen::Vector3f& point : points) point = {metres(random), metres(random), metres(random)};
    publish(points);
    return !node_->running();
  }));
  EXPECT_EQ(node_->exitCode(), 0) << node_->output();
  EXPECT_TRUE(node_->hasSaid("not enough memory")) << node_->output();
}

#endif

}  // namespace
}  // namespace grid_path_planner::nodes
