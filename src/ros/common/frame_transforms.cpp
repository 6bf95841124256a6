#include "ros/common/frame_transforms.h"

#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <chrono>
#include <sstream>
#include <thread>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::Stopped;
using base::StopReason;
using base::StopToken;
using path::Pose;

namespace {

std::string sentence(const std::string& target, const std::string& source, const ros::Time& stamp,
                     const std::string& reason) {
  std::ostringstream text;
  text << "no transform from " << source << " to " << target;
  if (!stamp.isZero()) text << " at " << stamp;
  text << ": " << reason;
  return text.str();
}

// tf2's reason for a frame that nobody publishes speaks of the arguments of a function.
std::string reasonOf(const tf2_ros::Buffer& buffer, const std::string& target,
                     const std::string& source, const std::string& otherwise) {
  std::string missing;
  for (const std::string& frame : {source, target})
    if (!buffer._frameExists(frame)) missing += (missing.empty() ? "'" : " or '") + frame + "'";
  return missing.empty() ? otherwise : "nothing on /tf names the frame " + missing;
}

}  // namespace

FrameTransforms::FrameTransforms(const ros::NodeHandle& nh) : listener_(buffer_, nh, true) {}

Pose FrameTransforms::poseIn(const std::string& frame, const geometry_msgs::PoseStamped& pose,
                             double limit, const StopToken& stop) const {
  const std::string source = frameName(pose.header.frame_id);
  if (source.empty()) throw InputError("a pose must name its frame");
  const Pose level = poseFromMessage(pose.pose);
  if (source == frame) return level;
  const auto transform = lookup(frame, source, pose.header.stamp, limit, stop);
  geometry_msgs::PoseStamped moved;
  tf2::doTransform(pose, moved, transform);
  Pose result;
  result.position = {moved.pose.position.x, moved.pose.position.y, moved.pose.position.z};
  result.yaw = yawOf(moved.pose.orientation);
  return result;
}

Pose FrameTransforms::poseOf(const std::string& vehicle, const std::string& frame, double limit,
                             const StopToken& stop) const {
  const auto transform = lookup(frame, frameName(vehicle), ros::Time(0), limit, stop).transform;
  Pose pose;
  pose.position = {transform.translation.x, transform.translation.y, transform.translation.z};
  pose.yaw = yawOf(transform.rotation);
  return pose;
}

geometry_msgs::TransformStamped FrameTransforms::lookup(const std::string& target,
                                                        const std::string& source,
                                                        const ros::Time& stamp, double limit,
                                                        const StopToken& stop) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit);
  while (true) {
    try {
      return buffer_.lookupTransform(target, source, stamp);
    } catch (const tf2::TransformException& error) {
      if (std::chrono::steady_clock::now() >= end)
        throw TransformError(
            sentence(target, source, stamp, reasonOf(buffer_, target, source, error.what())));
    }
    if (stop.reason() != StopReason::NONE) throw Stopped(stop.reason());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace grid_path_planner::nodes
