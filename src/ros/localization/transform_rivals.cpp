#include "ros/localization/transform_rivals.h"

#include <ros/message_event.h>
#include <ros/this_node.h>

#include <algorithm>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/common/incoming/claimed_lengths.h"
#include "ros/common/network_text.h"

namespace grid_path_planner::nodes {

namespace {

constexpr std::size_t kRemembered = 500;

}  // namespace

TransformRivals::TransformRivals(ros::NodeHandle nh, const std::vector<std::string>& children)
    : children_(children) {
  using Event = ros::MessageEvent<const tf2_msgs::TFMessage>;
  subscriber_ = subscribeChecked<tf2_msgs::TFMessage, const Event&>(
      nh, "/tf", 200,
      [this](const Event& event) { hear(*event.getConstMessage(), event.getPublisherName()); });
}

void TransformRivals::sent(const ros::Time& stamp) {
  sent_.push_back(stamp);
  if (sent_.size() > kRemembered) sent_.pop_front();
}

bool TransformRivals::isOurs(const ros::Time& stamp, const std::string& node) const {
  return node == ros::this_node::getName() &&
         std::find(sent_.rbegin(), sent_.rend(), stamp) != sent_.rend();
}

void TransformRivals::hear(const tf2_msgs::TFMessage& message, const std::string& node) {
  if (!rival_.empty()) return;
  for (const auto& transform : message.transforms) {
    const std::string child = frameName(transform.child_frame_id);
    if (std::find(children_.begin(), children_.end(), child) == children_.end()) continue;
    if (isOurs(transform.header.stamp, node)) continue;
    rival_ = printable(node) + " publishes tf " + printable(transform.header.frame_id) + " -> " +
             child + " too";
    return;
  }
}

}  // namespace grid_path_planner::nodes
