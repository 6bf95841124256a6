#include "ros/messages/pose_reading.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/level_quaternion.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/conversions.h"

namespace grid_path_planner::nodes {

using base::decimalText;
using base::InputError;

namespace {

constexpr double kSlack = 0.1;  // of the length
constexpr double kMostTilt =
    0.0447251;                    // rad; move_base's: the z axis leans by up to 1e-3 of its length
constexpr double kUntold = 0.01;  // of the length, and rad

void checkFinite(const geometry_msgs::Point& point) {
  for (const double coordinate : {point.x, point.y, point.z})
    if (!std::isfinite(coordinate))
      throw InputError("a coordinate must be a finite number of metres, got " +
                       decimalText(coordinate));
}

// What is told of it.
const char* readOrientation(const geometry_msgs::Quaternion& q) {
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(std::abs(length - 1.0) <= kSlack))
    throw InputError(
        "an orientation must be a quaternion of length 1 (w: 1 alone looks along x), got length " +
        decimalText(length));
  // The angle between the pose's z axis and the frame's.
  const double tilt = 2.0 * std::asin(std::min(1.0, std::hypot(q.x, q.y) / length));
  if (tilt > kMostTilt)
    throw InputError("an orientation must be level, got one tilted by " + std::to_string(tilt) +
                     " rad");
  if (tilt > kUntold) return "its orientation tilts by up to 2.56 degrees: it is taken as level";
  if (std::abs(length - 1.0) > kUntold)
    return "its quaternion is not of length 1, as typed by hand: it is normalised";
  return nullptr;
}

}  // namespace

PoseReading readPose(const geometry_msgs::Pose& message, ZeroHeading zero_heading) {
  checkFinite(message.position);
  const geometry_msgs::Quaternion& q = message.orientation;
  PoseReading read;
  read.pose.position = {message.position.x, message.position.y, message.position.z};
  if (!base::isZeroQuaternion(q.x, q.y, q.z, q.w)) {
    read.told = readOrientation(q);
    read.pose.yaw = yawOf(q);
  } else if (zero_heading == ZeroHeading::ANY) {
    read.pose.yaw = std::numeric_limits<double>::quiet_NaN();
  } else {
    throw InputError(
        "an orientation of zeros gives no heading: w: 1 alone looks along x, and where the "
        "parameter zero_heading is any, every heading will do");
  }
  return read;
}

void checkCoordinates(const Eigen::Vector3d& position) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(position[axis]) <= path::kLargestCoordinate))  // NaN fails it
      throw InputError("a coordinate must be a finite number of metres within 1e6, got " +
                       decimalText(position[axis]));
}

}  // namespace grid_path_planner::nodes
