#include "ros/localization/transform_rivals.h"

#include <ros/this_node.h>

#include <algorithm>
#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/common/network_text.h"

namespace grid_path_planner::nodes {

namespace {

constexpr std::size_t kRemembered = 500;

}  // namespace

TransformRivals::TransformRivals(std::vector<std::string> children)
    : children_(std::move(children)) {}

void TransformRivals::sent(const ros::Time& stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  sent_.push_back(stamp);
  if (sent_.size() > kRemembered) sent_.pop_front();
}

std::string TransformRivals::rival() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_rival_.empty() ? rival_ : static_rival_;
}

void TransformRivals::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  rival_.clear();
}

bool TransformRivals::isOurs(const ros::Time& stamp, const std::string& node) const {
  return node == ros::this_node::getName() &&
         std::find(sent_.rbegin(), sent_.rend(), stamp) != sent_.rend();
}

void TransformRivals::hear(const tf2_msgs::TFMessage& message, const std::string& node,
                           bool is_static) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string& rival = is_static ? static_rival_ : rival_;
  if (!rival.empty()) return;
  for (const auto& transform : message.transforms) {
    const std::string child = frameName(transform.child_frame_id);
    if (std::find(children_.begin(), children_.end(), child) == children_.end()) continue;
    if (!is_static && isOurs(transform.header.stamp, node)) continue;
    rival = printable(node) + " publishes tf " + printable(transform.header.frame_id) + " -> " +
            child + " too";
    rival += is_static ? ", a static one, which tf keeps: end it and start this node again"
                       : ": end it and call ~reset";
    return;
  }
}

}  // namespace grid_path_planner::nodes
