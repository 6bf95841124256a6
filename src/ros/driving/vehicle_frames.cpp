#include "ros/driving/vehicle_frames.h"

#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <cmath>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using base::InputError;
using path::Path;
using path::Pose;

VehicleFrames::VehicleFrames(const ros::NodeHandle& nh) : listener_(buffer_, nh) {}

std::optional<Pose> VehicleFrames::pose(const std::string& vehicle, const std::string& frame,
                                        const ros::Time& now, double timeout,
                                        std::string& why) const {
  try {
    const auto found = buffer_.lookupTransform(frame, vehicle, ros::Time(0));
    const double age = (now - found.header.stamp).toSec();
    if (!found.header.stamp.isZero() && std::abs(age) > timeout) {  // 0: all of it is static
      why = "the pose of " + vehicle + " in " + frame + " is " + std::to_string(age) + " s old";
      return std::nullopt;
    }
    const auto& at = found.transform.translation;
    return Pose{{at.x, at.y, at.z}, yawOf(found.transform.rotation)};
  } catch (const tf2::TransformException& error) {
    why = "the pose of " + vehicle + " in " + frame + " is not known: " + error.what();
    return std::nullopt;
  }
}

void VehicleFrames::checkKnown(const std::string& frame, const std::string& vehicle) const {
  if (frame.empty()) throw InputError("a path must name its frame, got an empty frame_id");
  if (!buffer_._frameExists(frame) && buffer_._frameExists(vehicle))
    throw InputError("the frame '" + frame + "' is not known to tf");
}

Path VehicleFrames::pathIn(const nav_msgs::Path& message, const std::string& vehicle) const {
  const std::string frame = frameName(message.header.frame_id);
  checkKnown(frame, vehicle);
  nav_msgs::Path path = message;
  path.header.frame_id = frame;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    geometry_msgs::PoseStamped& pose = path.poses[i];
    const std::string own = frameName(pose.header.frame_id);
    if (own.empty() || own == frame) continue;
    try {
      poseFromMessage(pose.pose);
      tf2::doTransform(pose.pose, pose.pose, buffer_.lookupTransform(frame, own, ros::Time(0)));
    } catch (const tf2::TransformException& error) {
      throw InputError("pose " + std::to_string(i + 1) +
                       " of the path cannot be transformed from '" + own + "' to '" + frame +
                       "': " + error.what());
    } catch (const InputError& error) {
      throw InputError("pose " + std::to_string(i + 1) + " of the path: " + error.what());
    }
  }
  return pathFromMessage(path);
}

std::vector<Eigen::Vector3d> VehicleFrames::points(std::vector<Eigen::Vector3d> points,
                                                   const std::string& from,
                                                   const std::string& to) const {
  if (from == to) return points;
  try {
    const auto transform = buffer_.lookupTransform(to, from, ros::Time(0));
    for (Eigen::Vector3d& point : points) {
      geometry_msgs::Point message;
      message.x = point.x();
      message.y = point.y();
      message.z = point.z();
      tf2::doTransform(message, message, transform);
      point = {message.x, message.y, message.z};
    }
    return points;
  } catch (const tf2::TransformException& error) {
    throw InputError("no transform from '" + from + "' to '" + to + "': " + error.what());
  }
}

}  // namespace grid_path_planner::nodes
