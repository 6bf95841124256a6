// What /tf may say, and what is asked of tf then.
#include <tf2_msgs/TFMessage.h>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "ros/input/transform_receiver.h"

namespace grid_path_planner::fuzz {
namespace {

const ros::Time kNow(1000, 0);

geometry_msgs::TransformStamped transformOf(const std::string& parent, const std::string& child,
                                            const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.header.stamp = stamp;
  transform.child_frame_id = child;
  transform.transform.translation.x = 1.0;
  transform.transform.rotation.w = 1.0;
  return transform;
}

std::vector<std::string> seedsOfTransforms() {
  tf2_msgs::TFMessage chain;
  chain.transforms = {transformOf("map", "odom", kNow), transformOf("odom", "base_link", kNow)};
  tf2_msgs::TFMessage times;
  times.transforms = {transformOf("map", "base_link", ros::Time(999, 0)),
                      transformOf("map", "base_link", ros::Time(4294967295u, 999999999u)),
                      transformOf("map", "base_link", ros::Time(0, 0))};
  return {bytesOf(chain), bytesOf(times)};
}

FUZZ_TARGET(transform_message, seedsOfTransforms) {
  const auto message = messageOf<tf2_msgs::TFMessage>(input);
  if (!message) return;
  tf2::BufferCore buffer;
  nodes::TransformStamps stamps;
  for (const geometry_msgs::TransformStamped& transform : message->transforms)
    nodes::insertTransform(buffer, stamps, transform, "/fuzz", transform.header.seq == 1, kNow);
  try {
    buffer.lookupTransform("map", "base_link", ros::Time(0));
  } catch (const tf2::TransformException&) {
  }
}

}  // namespace
}  // namespace grid_path_planner::fuzz
