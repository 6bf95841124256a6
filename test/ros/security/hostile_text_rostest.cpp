// Names of frames that are more than names. Seen before: a map in the frame $(touch x) was planned
// on, and what a shell would run stood in the waypoint file.
#include <dynamic_reconfigure/Reconfigure.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include "grid_path_planner/ComparePlans.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/support/planner_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using test::poseAt;
using test::Process;

const std::vector<std::string> kHostile = {"$(touch x)",
                                           "`touch x`",
                                           "a\"b",
                                           "a'b",
                                           "a\\b",
                                           "map\nheader: x",
                                           "\x1b[2J",
                                           "map\x7f",
                                           "\x9b"
                                           "2J",
                                           "\xff\xfe",
                                           std::string("map\0x", 5),
                                           std::string(257, 'm')};
constexpr char kRefusal[] = "the name of a frame";

class HostileText : public test::PlannerTest {
 protected:
  // Publishes until the node says what it thinks of it; it may not be connected yet.
  template <class Message>
  bool refuses(Process& node, const ros::Publisher& publisher, const Message& message) {
    return test::waitFor([&] {
      publisher.publish(message);
      return node.output().find(kRefusal) != std::string::npos;
    });
  }
  nav_msgs::OccupancyGrid mapIn(const std::string& frame) {
    return occupancyToMessage(test::AsciiMap({"....", "...."}).map, frame, ros::Time::now());
  }
};

TEST_F(HostileText, PathPlannerTakesNoMapInSuchAFrame) {
  startPlanner();
  for (const std::string& frame : kHostile) {
    maps_.publish(mapIn(frame));
    makePlan(poseAt(0.5, 0.5), poseAt(3.5, 0.5));
    EXPECT_EQ(answer_.status, "NO_MAP") << frame;
  }
  EXPECT_TRUE(planner_->says(kRefusal));
  publishMap({"....", "...."});
  map_msgs::OccupancyGridUpdate update;
  update.header.frame_id = kHostile.front();
  update.header.stamp = ros::Time::now();
  update.width = update.height = 1;
  update.data = {100};
  updates_.publish(update);
  makePlan(poseAt(0.5, 0.5), poseAt(3.5, 0.5));
  EXPECT_EQ(answer_.status, "FOUND") << "the map before stays";
}

TEST_F(HostileText, RequestsAreRefusedAndTheAnswerRepeatsNothing) {
  startPlanner();
  publishMap({"....", "...."});
  for (const std::string& frame : kHostile) {
    makePlan(poseAt(0.5, 0.5), poseAt(3.5, 0.5, 0.0, frame));
    EXPECT_EQ(answer_.status, "INVALID_REQUEST") << frame;
    EXPECT_EQ(answer_.goal.header.frame_id, "");
    EXPECT_EQ(answer_.message.find(frame), std::string::npos) << answer_.message;
    makePlan(poseAt(0.5, 0.5, 0.0, frame), poseAt(3.5, 0.5));
    EXPECT_EQ(answer_.status, "INVALID_REQUEST") << frame;
  }
  ComparePlans call;
  call.request.start = poseAt(0.5, 0.5);
  call.request.goal = poseAt(3.5, 0.5);
  call.request.planners = kHostile;
  ASSERT_TRUE(ros::service::call("/path_planner/compare_plans", call));
  for (const auto& result : call.response.results) {
    EXPECT_EQ(result.status, "INVALID_REQUEST");
    for (const std::string& text : kHostile)
      EXPECT_EQ((result.message + result.planner).find(text), std::string::npos);
  }
}

TEST_F(HostileText, TheOtherNodesRefuseItToo) {
  const std::string& frame = kHostile.front();
  {
    Process navigate("navigate_path", {"_follow_latched:=true"});
    const auto paths = nh_.advertise<nav_msgs::Path>("path", 1);
    nav_msgs::Path path;
    path.header.frame_id = frame;
    path.poses.push_back(poseAt(1.0, 1.0, 0.0, frame));
    EXPECT_TRUE(refuses(navigate, paths, path));
  }
  {
    Process mapping("projected_map", {});
    const auto clouds = nh_.advertise<sensor_msgs::PointCloud2>("cloud_in", 1);
    sensor_msgs::PointCloud2 cloud;
    cloud.header.frame_id = frame;
    EXPECT_TRUE(refuses(mapping, clouds, cloud));
  }
  Process simulator("simulator", {});
  EXPECT_TRUE(refuses(simulator, maps_, mapIn(frame)));
}

// Names in transforms and clouds, and values of parameters, went into the log as they came: lines that nobody had
// written, escape sequences, 20 MB at a time.
TEST_F(HostileText, NothingOfItStandsInTheLog) {
  const std::string forged = "\x1b]0;owned\x07\n[FATAL] the vehicle stands";
  const std::string large(5000000, 'm');
  Process mapping("projected_map", {});
  const auto clouds = nh_.advertise<sensor_msgs::PointCloud2>("cloud_in", 1);
  const auto transforms = nh_.advertise<tf2_msgs::TFMessage>("/tf", 10);
  ASSERT_TRUE(test::waitFor([&] {
    return clouds.getNumSubscribers() > 0 && transforms.getNumSubscribers() > 0 &&
           ros::service::exists("/projected_map/set_parameters", false);
  }));
  for (const std::string& text : {forged, large}) {
    sensor_msgs::PointCloud2 cloud;
    cloud.header.frame_id = "map";
    cloud.header.stamp = ros::Time::now();
    cloud.fields.resize(1);
    cloud.fields[0].name = text;
    clouds.publish(cloud);
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    message.transforms[0].header.frame_id = "map";
    message.transforms[0].child_frame_id = text;
    transforms.publish(message);
    for (const char* option : {"projection_min_z", "projection_reference", "filename"}) {
      dynamic_reconfigure::Reconfigure call;
      call.request.config.strs.resize(1);
      call.request.config.strs[0].name = option;
      call.request.config.strs[0].value = text;
      ASSERT_TRUE(ros::service::call("/projected_map/set_parameters", call)) << option;
    }
  }
  EXPECT_TRUE(mapping.says("the cloud has no field x"));
  EXPECT_TRUE(mapping.says("a name of its frames is no text that may be told"));
  EXPECT_TRUE(mapping.says("projection_min_z must not hold control characters"));
  EXPECT_EQ(mapping.output().find("]0;owned"), std::string::npos);
  EXPECT_EQ(mapping.output().find("\n[FATAL] the vehicle"), std::string::npos);
  EXPECT_LT(mapping.output().size(), 100000u);
}

TEST_F(HostileText, SuchParametersEndANodeAtItsStart) {
  const std::vector<std::pair<std::string, std::string>> options = {
      {"path_planner", "map_frame"},   {"path_planner", "base_frame"},
      {"navigate_path", "base_frame"}, {"projected_map", "frame_id"},
      {"simulator", "odom_frame"},     {"map_publisher", "frame_id"}};
  for (const auto& [node, option] : options) {
    ros::param::set("/" + node + "/" + option, "$(touch x)");
    Process process(node, node == "map_publisher"
                              ? std::vector<std::string>{GPP_TEST_DATA "/projected_map.bag"}
                              : std::vector<std::string>{});
    EXPECT_TRUE(process.waitForExit()) << node;
    EXPECT_EQ(process.exitCode(), 1) << node << ' ' << option;
    ros::param::del("/" + node);
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
