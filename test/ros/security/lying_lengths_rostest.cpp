// Messages, requests of services and goals of actions of 200 bytes that claim to hold gigabytes: three
// messages took 4.17 GB of two nodes, a request 1.9 GB.
#include <actionlib_msgs/GoalStatusArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/ComparePlans.h"
#include "grid_path_planner/NavigatePathActionGoal.h"
#include "ros/support/process.h"
#include "ros/support/raw_bytes.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

using test::RawBytes;

// Where a message without any elements has the length of an array: so many bytes before its end.
template <class Message>
constexpr std::size_t kFromEnd = 4;
template <>
constexpr std::size_t kFromEnd<sensor_msgs::PointCloud2> = 5;
template <>
constexpr std::size_t kFromEnd<NavigatePathActionGoal> = 8;  // a name follows

// A message with an array that claims so many elements, of which 100 bytes are there.
template <class Message>
std::vector<std::uint8_t> lie(std::uint32_t claimed) {
  return test::lyingBytes<Message>(claimed, kFromEnd<Message>);
}

std::size_t refusals(const test::Process& node) {
  const std::string text = node.output();
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find("it claims", at)) != std::string::npos; ++at) ++count;
  return count;
}

template <class Message>
void tellLies(test::Process& node, const std::string& topic, std::uint32_t claimed) {
  ros::NodeHandle nh;
  ros::Publisher publisher = nh.advertise<RawBytes<Message>>(topic, 10);
  ASSERT_TRUE(test::waitFor([&] { return publisher.getNumSubscribers() > 0; })) << topic;
  const std::size_t before = refusals(node);
  publisher.publish(RawBytes<Message>{lie<Message>(claimed)});
  EXPECT_TRUE(test::waitFor([&] { return refusals(node) > before; })) << topic;
}

// As roscpp sends a request: its length, then the message.
template <class Service>
void askLies(test::Process& node, const std::string& service, std::uint32_t claimed) {
  ASSERT_TRUE(test::waitFor([&] { return ros::service::exists(service, false); })) << service;
  const auto bytes = lie<typename Service::Request>(claimed);
  const auto length = static_cast<std::uint32_t>(bytes.size());
  ros::SerializedMessage request(
      boost::shared_array<std::uint8_t>(new std::uint8_t[length + sizeof length]),
      length + sizeof length);
  std::memcpy(request.buf.get(), &length, sizeof length);
  std::memcpy(request.buf.get() + sizeof length, bytes.data(), length);
  ros::NodeHandle nh;
  ros::ServiceClient client = nh.serviceClient<Service>(service);
  ros::SerializedMessage response;
  const std::size_t before = refusals(node);
  EXPECT_FALSE(client.call(request, response, ros::service_traits::md5sum<Service>())) << service;
  EXPECT_TRUE(test::waitFor([&] { return refusals(node) > before; })) << service;
}

constexpr std::size_t kMostMemory = std::size_t{1} << 30;  // bytes

TEST(LyingLengths, TakeNoMemoryOfPathPlanner) {
  test::Process node("path_planner", {});
  tellLies<nav_msgs::OccupancyGrid>(node, "/projected_map", 4000000000U);
  tellLies<map_msgs::OccupancyGridUpdate>(node, "/projected_map_updates", 4000000000U);
  tellLies<tf2_msgs::TFMessage>(node, "/tf", 20000000U);
  EXPECT_TRUE(node.running());
  EXPECT_LT(node.peakMemory(), kMostMemory);
}

// A status has no fixed size, so its elements are stepped over one by one.
TEST(LyingLengths, TakeNoMemoryOfGoToPose) {
  test::Process node("go_to_pose", {});
  tellLies<actionlib_msgs::GoalStatusArray>(node, "/plan_path/status", 20000000U);
  tellLies<actionlib_msgs::GoalStatusArray>(node, "/navigate_path/status", 20000000U);
  EXPECT_TRUE(node.running());
  EXPECT_LT(node.peakMemory(), kMostMemory);
}

TEST(LyingLengths, TakeNoMemoryOfNavigatePath) {
  test::Process node("navigate_path", {});
  tellLies<nav_msgs::OccupancyGrid>(node, "/projected_map", 4000000000U);
  tellLies<nav_msgs::Path>(node, "/path", 20000000U);
  EXPECT_TRUE(node.running());
  EXPECT_LT(node.peakMemory(), kMostMemory);
}

TEST(LyingLengths, TakeNoMemoryOfProjectedMap) {
  test::Process node("projected_map", {"_autosave_period:=0"});
  tellLies<sensor_msgs::PointCloud2>(node, "/cloud_in", 4000000000U);
  EXPECT_TRUE(node.running());
  EXPECT_LT(node.peakMemory(), kMostMemory);
}

TEST(LyingLengths, TakeNoMemoryOfMapLayers) {
  test::Process node("map_layers", {"_use_scan:=true", "_use_keep_out_mask:=true"});
  tellLies<nav_msgs::OccupancyGrid>(node, "/static_map", 4000000000U);
  tellLies<nav_msgs::OccupancyGrid>(node, "/keep_out_mask", 4000000000U);
  tellLies<sensor_msgs::LaserScan>(node, "/scan", 1000000000U);
  EXPECT_TRUE(node.running());
  EXPECT_LT(node.peakMemory(), kMostMemory);
}

TEST(LyingLengths, TakeNoMemoryOfMarkerLocalizer) {
  test::Process node("marker_localizer", {"--layout=" GPP_TEST_DATA "/two_markers.yaml"});
  tellLies<sensor_msgs::Image>(node, "/camera/image_raw", 4000000000U);
  EXPECT_TRUE(node.running());
  EXPECT_LT(node.peakMemory(), kMostMemory);
}

TEST(LyingLengths, OfRequestsTakeNoMemory) {
  test::Process node("path_planner", {});
  askLies<ComparePlans>(node, "/path_planner/compare_plans", 60000000U);
  askLies<dynamic_reconfigure::Reconfigure>(node, "/path_planner/set_parameters", 40000000U);
  EXPECT_TRUE(node.running());
  EXPECT_LT(node.peakMemory(), kMostMemory);
}

TEST(LyingLengths, OfGoalsOfActionsTakeNoMemory) {
  test::Process node("navigate_path", {});
  tellLies<NavigatePathActionGoal>(node, "/navigate_path/goal", 20000000U);
  EXPECT_TRUE(node.running());
  EXPECT_LT(node.peakMemory(), kMostMemory);
}

}  // namespace
}  // namespace grid_path_planner::nodes
