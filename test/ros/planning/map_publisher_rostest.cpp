#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <gtest/gtest.h>
#include <nav_msgs/GetMap.h>
#include <nav_msgs/MapMetaData.h>
#include <ros/ros.h>

#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "support/ascii_map.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {

using grid::OccupancyGrid;
using grid::writeMovingAiFile;

namespace {

class MapPublisherTest : public testing::Test {
 protected:
  MapPublisherTest() { ros::param::del("/map_publisher"); }
  std::string fileOf(const std::string& name, const OccupancyGrid& map) {
    writeMovingAiFile(folder_.path(name), map);
    return folder_.path(name);
  }
  // Exit code and output of a map_publisher that ends by itself.
  std::pair<int, std::string> refusal(const std::vector<std::string>& arguments) {
    test::Process process("map_publisher", arguments);
    EXPECT_TRUE(process.waitForExit());
    return {process.exitCode(), process.output()};
  }

  ros::NodeHandle nh_;
  const test::TemporaryFolder folder_;
  const OccupancyGrid map_ = test::AsciiMap({"..#", "#.."}).map;
};

TEST_F(MapPublisherTest, PublishesLatchedWithMetadataAndService) {
  const test::Process process(
      "map_publisher", {"_filename:=" + fileOf("a.map", map_), "--load-folder", folder_.path(""),
                        "_frame_id:=/site", "_topic:=ground"});
  test::Latest<nav_msgs::OccupancyGrid> maps(nh_, "ground");
  const auto message = maps.waitForMoreThan(0);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->header.frame_id, "site");
  EXPECT_FALSE(message->header.stamp.isZero());
  EXPECT_EQ(occupancyFromMessage(*message), map_);

  test::Latest<nav_msgs::OccupancyGrid> late(nh_, "ground");
  EXPECT_TRUE(late.waitForMoreThan(0)) << "latched";
  test::Latest<nav_msgs::MapMetaData> metadata(nh_, "map_metadata");
  const auto info = metadata.waitForMoreThan(0);
  ASSERT_TRUE(info);
  EXPECT_EQ(info->width, 3u);
  nav_msgs::GetMap call;
  ASSERT_TRUE(ros::service::call("static_map", call));
  EXPECT_EQ(occupancyFromMessage(call.response.map), map_);
}

// An office of 30 m was published as one of 620 m.
TEST_F(MapPublisherTest, AnImageAloneIsWarnedOf) {
  const std::string file = folder_.path("alone.png");
  writeImageFile(file, map_);
  test::Process process("map_publisher", {"--filename", file});
  EXPECT_TRUE(process.says(
      "alone.png: is an image without a YAML, so each pixel is taken for a cell of 1 m"));
  EXPECT_TRUE(process.says("3x2 cells of 1 m"));
}

TEST_F(MapPublisherTest, ReadsBagsToo) {
  const test::Process process("map_publisher", {"--filename", GPP_TEST_DATA "/projected_map.bag"});
  test::Latest<nav_msgs::OccupancyGrid> maps(nh_, "projected_map");
  const auto message = maps.waitForMoreThan(0);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->header.frame_id, "map");
  EXPECT_EQ(message->info.width, 80u);
}

// As with map_server.
TEST_F(MapPublisherTest, TakesTheFileAsItsArgument) {
  const test::Process process("map_publisher", {fileOf("a.map", map_), "_frame_id:=site"});
  test::Latest<nav_msgs::OccupancyGrid> maps(nh_, "projected_map");
  const auto message = maps.waitForMoreThan(0);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->header.frame_id, "site");
  EXPECT_EQ(occupancyFromMessage(*message), map_);
}

TEST_F(MapPublisherTest, OtherArgumentsAreRefused) {
  const std::string usage =
      "usage: map_publisher [[--filename] MAP_FILE] [--save-folder FOLDER] [--load-folder FOLDER] "
      "[_parameter:=value]";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"a.map", "b.map"}, {"--frame=map"}}) {
    const auto [code, said] = refusal(arguments);
    EXPECT_EQ(code, 2) << arguments[0];
    EXPECT_NE(said.find(usage), std::string::npos) << said;
  }
  EXPECT_EQ(refusal({"--help"}).first, 0);
  EXPECT_NE(refusal({"--help"}).second.find(usage), std::string::npos);
}

TEST_F(MapPublisherTest, WithoutAMapItFailsLoudly) {
  const auto [no_name, first] = refusal({});
  EXPECT_EQ(no_name, 1);
  EXPECT_NE(first.find("filename must name a map file"), std::string::npos) << first;
  EXPECT_NE(first.find("`map_publisher FILE`"), std::string::npos) << "and how: " << first;
  const auto [missing, second] = refusal({"--filename", "/no/such/map.yaml"});
  EXPECT_EQ(missing, 1);
  EXPECT_NE(second.find("/no/such/map.yaml"), std::string::npos) << second;
}

TEST_F(MapPublisherTest, AnotherFileIsPublishedWhileItRunsAndABadOneIsRefused) {
  const std::string first = fileOf("a.map", map_);
  const OccupancyGrid other = test::AsciiMap({"....", "####"}).map;
  const test::Process process("map_publisher",
                              {"_filename:=" + first, "--load-folder", folder_.path("")});
  test::Latest<nav_msgs::OccupancyGrid> maps(nh_, "projected_map");
  ASSERT_TRUE(maps.waitForMoreThan(0));
  const auto reconfigured = [](const std::string& filename) {
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, "filename", filename);
    EXPECT_TRUE(ros::service::call("/map_publisher/set_parameters", call));
    std::string answer;
    dynamic_reconfigure::ConfigTools::getParameter(call.response.config, "filename", answer);
    return answer;
  };
  EXPECT_EQ(reconfigured("/no/such/map.yaml"), first);
  const std::string second = fileOf("b.map", other);
  EXPECT_EQ(reconfigured(second), second);
  const auto message = maps.waitForMoreThan(1);
  ASSERT_TRUE(message);
  EXPECT_EQ(occupancyFromMessage(*message), other);
}

}  // namespace
}  // namespace grid_path_planner::nodes
