#include "ros/localization/transform_rivals.h"

#include <ros/this_node.h>

#include <algorithm>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

namespace {

constexpr std::size_t kRemembered = 1000;
constexpr double kListens = 0.5;  // s of the wall clock, before the first transform

}  // namespace

TransformRivals::TransformRivals(std::vector<std::string> children)
    : children_(std::move(children)) {}

void TransformRivals::sent(const std::string& child, const ros::Time& stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  sent_.push_back({child, stamp});
  if (sent_.size() > kRemembered) sent_.pop_front();
}

bool TransformRivals::isKnown() const {
  return (ros::SteadyTime::now() - since_).toSec() >= kListens;
}

std::string TransformRivals::rival() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_rival_.empty() ? rival_ : static_rival_;
}

void TransformRivals::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  rival_.clear();
}

// Each that was sent is heard once.
bool TransformRivals::isOurs(const std::string& child, const ros::Time& stamp,
                             const std::string& node) {
  if (node != ros::this_node::getName()) return false;
  const auto found = std::find_if(sent_.begin(), sent_.end(), [&](const Sent& sent) {
    return sent.stamp == stamp && sent.child == child;
  });
  if (found == sent_.end()) return false;
  sent_.erase(found);
  return true;
}

// A sentence; empty where the transform is ours, or of a frame that is not.
std::string TransformRivals::rivalIn(const geometry_msgs::TransformStamped& transform,
                                     const std::string& node, bool is_static) {
  const std::string child = frameName(transform.child_frame_id);
  if (std::find(children_.begin(), children_.end(), child) == children_.end()) return {};
  if (!is_static && isOurs(child, transform.header.stamp, node)) return {};
  return printable(node) + " publishes tf " + printable(transform.header.frame_id) + " -> " +
         child + " too" +
         (is_static ? ", a static one, which tf keeps: end it and start this node again"
                    : ": end it and call ~reset");
}

void TransformRivals::hear(const tf2_msgs::TFMessage& message, const std::string& node,
                           bool is_static) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string& rival = is_static ? static_rival_ : rival_;
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    try {
      const std::string found = rivalIn(transform, node, is_static);
      if (rival.empty()) rival = found;
    } catch (const base::InputError&) {  // a name that is none is not of our frames
    }
  }
}

}  // namespace grid_path_planner::nodes
