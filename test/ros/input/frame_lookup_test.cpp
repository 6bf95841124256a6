#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ros/input/frame_lookup.h"

namespace grid_path_planner::nodes {
namespace {

// What the fuzzer found: tf2 subtracts the times for the text of its error, and roscpp throws another where they are 2^31 s
// apart. A goal stamped 2065 was given up without a word to who had sent it.
TEST(FrameLookup, SaysThatATimeFarFromAllOfTfIsNoneOfIt) {
  for (const auto& [known, asked] : {std::pair<std::uint32_t, std::uint32_t>{10, 3000000000},
                                     std::pair<std::uint32_t, std::uint32_t>{3000000000, 10}}) {
    FrameLookup lookup;
    for (std::uint32_t second : {known, known + 1}) {
      geometry_msgs::TransformStamped transform;
      transform.header.stamp = ros::Time(second, 0);
      transform.header.frame_id = "map";
      transform.child_frame_id = "odom";
      transform.transform.rotation.w = 1.0;
      lookup.buffer().setTransform(transform, "test");
    }
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = "odom";
    pose.header.stamp = ros::Time(asked, 0);
    pose.pose.orientation.w = 1.0;
    EXPECT_THROW(lookup.poseIn("map", pose, "map", 0.0, {}), TransformError) << asked;
    EXPECT_THROW(lookup.transform("map", "odom", pose.header.stamp), TransformError) << asked;
  }
}

void join(FrameLookup& lookup, const std::string& parent, const std::string& child) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time(10, 0);
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.rotation.w = 1.0;
  lookup.buffer().setTransform(transform, "test", true);
}

// What was seen before, by reading: a path in odom was compared with a map by a transform of any age.
TEST(FrameLookup, TellsAnOldTransformFromAStaticOneAndOneStampedAhead) {
  FrameLookup lookup;
  join(lookup, "earth", "map");
  geometry_msgs::TransformStamped moving;
  moving.header.stamp = ros::Time(10, 0);
  moving.header.frame_id = "map";
  moving.child_frame_id = "odom";
  moving.transform.rotation.w = 1.0;
  lookup.buffer().setTransform(moving, "test");
  EXPECT_NO_THROW(lookup.checkNotOlder("map", "odom", ros::Time(10.4), 0.5));
  EXPECT_NO_THROW(lookup.checkNotOlder("map", "odom", ros::Time(8.0), 0.5));
  EXPECT_NO_THROW(lookup.checkNotOlder("odom", "odom", ros::Time(1000.0), 0.5));
  EXPECT_NO_THROW(lookup.checkNotOlder("earth", "map", ros::Time(1000.0), 0.5));
  for (const auto& [to, from] : {std::pair("map", "odom"), std::pair("odom", "earth")})
    for (const double now : {10.6, 4294967295.0})
      EXPECT_THROW(lookup.checkNotOlder(to, from, ros::Time(now), 0.5), TransformError) << now;
  EXPECT_THROW(lookup.checkNotOlder("map", "nowhere", ros::Time(10.0), 0.5), TransformError);
}

// earth -> map -> odom -> base_link -> imu_link, earth -> ship -> usbl
TEST(FrameLookup, TellsTheFramesByWhichOneLeadsToAnother) {
  FrameLookup lookup;
  for (const auto& [parent, child] :
       {std::pair("earth", "map"), std::pair("map", "odom"), std::pair("odom", "base_link"),
        std::pair("base_link", "imu_link"), std::pair("base_link", "dvl_link"),
        std::pair("earth", "ship"), std::pair("ship", "usbl"), std::pair("other", "alone")})
    join(lookup, parent, child);
  const auto between = [&](const char* one, const char* other) {
    const std::vector<std::string> frames = lookup.framesBetween(one, other);
    return std::set<std::string>(frames.begin(), frames.end());
  };
  using Frames = std::set<std::string>;
  EXPECT_EQ(between("imu_link", "dvl_link"), (Frames{"imu_link", "base_link", "dvl_link"}));
  EXPECT_EQ(between("base_link", "imu_link"), (Frames{"base_link", "imu_link"}));
  EXPECT_EQ(between("odom", "map"), (Frames{"odom", "map"}));
  EXPECT_EQ(between("imu_link", "usbl"),
            (Frames{"imu_link", "base_link", "odom", "map", "earth", "ship", "usbl"}));
  EXPECT_EQ(between("imu_link", "alone"), Frames{});
}

}  // namespace
}  // namespace grid_path_planner::nodes
