#include "ros/localization/transform_rivals.h"

#include <gtest/gtest.h>
#include <ros/this_node.h>

#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

geometry_msgs::TransformStamped linkTo(const std::string& child, double stamp) {
  geometry_msgs::TransformStamped link;
  link.header.frame_id = "map";
  link.header.stamp = ros::Time(stamp);
  link.child_frame_id = child;
  return link;
}

tf2_msgs::TFMessage messageOf(const std::vector<geometry_msgs::TransformStamped>& links) {
  tf2_msgs::TFMessage message;
  message.transforms = links;
  return message;
}

TEST(TransformRivals, WhatWasSentIsOurs) {
  TransformRivals rivals({"odom", "base_link"});
  rivals.sent("odom", ros::Time(7.0));
  rivals.sent("base_link", ros::Time(7.0));
  rivals.hear(messageOf({linkTo("base_link", 7.0), linkTo("/odom", 7.0), linkTo("camera", 7.0)}),
              ros::this_node::getName(), false);
  EXPECT_EQ(rivals.rival(), "");
}

// Two localizers of one manager that hear the same IMU send the same stamps, in the name of both.
TEST(TransformRivals, AStampThatComesTwiceWasSentByAnother) {
  TransformRivals rivals({"odom"});
  rivals.sent("odom", ros::Time(7.0));
  rivals.hear(messageOf({linkTo("odom", 7.0)}), ros::this_node::getName(), false);
  EXPECT_EQ(rivals.rival(), "");
  rivals.hear(messageOf({linkTo("odom", 7.0)}), ros::this_node::getName(), false);
  EXPECT_TRUE(test::contains(rivals.rival(), "publishes tf map -> odom too"));
}

TEST(TransformRivals, AStampIsOursForTheFrameThatItWasSentFor) {
  TransformRivals rivals({"odom", "base_link"});
  rivals.sent("odom", ros::Time(7.0));
  rivals.hear(messageOf({linkTo("base_link", 7.0)}), ros::this_node::getName(), false);
  EXPECT_TRUE(test::contains(rivals.rival(), "-> base_link too"));
}

// What came before it in the message was looked at, and what came after it not.
TEST(TransformRivals, ANameThatIsNoneHidesNothing) {
  TransformRivals rivals({"odom"});
  rivals.hear(messageOf({linkTo("bad\nname", 7.0), linkTo(std::string(100000, 'x'), 7.0),
                         linkTo("odom", 7.0)}),
              "/other", false);
  EXPECT_TRUE(test::contains(rivals.rival(), "/other publishes tf map -> odom too"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
