#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "ros/common/frame_transforms.h"

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

}  // namespace
}  // namespace grid_path_planner::nodes
