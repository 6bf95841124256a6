// tf2 writes of a transform that it does not take to stderr, under the lock that every lookup waits for: with a
// log that nobody read, one broadcaster that repeated a stamp stopped the control of a vehicle that drove.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "ros/input/transform_receiver.h"

namespace grid_path_planner::nodes {
namespace {

geometry_msgs::TransformStamped transformOf(const std::string& child, const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "map";
  transform.header.stamp = stamp;
  transform.child_frame_id = child;
  transform.transform.rotation.w = 1.0;
  return transform;
}

TEST(TransformStamps, AreTakenWhereTf2TakesThem) {
  std::mt19937 random(20261127);
  std::uniform_int_distribution<int> step(-130, 20), frame(0, 2);
  tf2::BufferCore buffer;
  TransformStamps stamps;
  int newest = 1000, taken = 0;  // tenths of a second
  for (int i = 0; i < 3000; ++i) {
    const int tenths = newest + step(random);
    newest = std::max(newest, tenths);
    const auto transform = transformOf("frame" + std::to_string(frame(random)),
                                       ros::Time(tenths / 10, tenths % 10 * 100000000));
    const bool takes = stamps.take(transform.child_frame_id, transform.header.stamp);
    ASSERT_EQ(takes, buffer.setTransform(transform, "test")) << tenths;
    taken += takes ? 1 : 0;
  }
  EXPECT_GT(taken, 300);
  EXPECT_LT(taken, 2700);
}

TEST(TransformStamps, TransformsThatAreDroppedForTheirStampsAreNoneThatCame) {
  const ros::Time now(1000.0);
  tf2::BufferCore buffer;
  TransformStamps stamps;
  EXPECT_NE(insertTransform(buffer, stamps, transformOf("base_link", ros::Time(5000.0)), "/far",
                            false, now),
            "");
  auto broken = transformOf("base_link", now);
  broken.transform.translation.x = std::nan("");
  insertTransform(buffer, stamps, broken, "/broken", false, now);
  broken.transform.translation.x = std::numeric_limits<double>::infinity();
  EXPECT_NE(insertTransform(buffer, stamps, broken, "/infinite", false, now), "")
      << "of a map by which no path can be looked at";
  EXPECT_EQ(insertTransform(buffer, stamps, transformOf("base_link", now), "/right", false, now),
            "");
  EXPECT_EQ(buffer.lookupTransform("map", "base_link", ros::Time(0)).header.stamp, now);
  EXPECT_EQ(insertTransform(buffer, stamps, transformOf("/base_link", now), "/again", false, now),
            "");
}

}  // namespace
}  // namespace grid_path_planner::nodes
