#include "ros/input/frame_lookup.h"

#include <ros/console.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <chrono>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <thread>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::Stopped;
using base::StopReason;
using base::StopToken;
using path::Path;
using path::Pose;

namespace {

Pose poseOfTransform(const geometry_msgs::Transform& transform) {
  const auto& position = transform.translation;
  return Pose{{position.x, position.y, position.z}, yawOf(transform.rotation)};
}

std::string sentence(const std::string& target, const std::string& source, const ros::Time& stamp,
                     const std::string& reason) {
  std::ostringstream text;
  text << "no transform from " << source << " to " << target;
  if (!stamp.isZero()) text << " at " << stamp;
  text << ": " << reason;
  return text.str();
}

// The newest transform of a frame in its parent; none for a root.
std::optional<geometry_msgs::TransformStamped> toParent(const tf2_ros::Buffer& buffer,
                                                        const std::string& frame) {
  std::string parent;
  if (!buffer._getParent(frame, ros::Time(0), parent)) return std::nullopt;
  try {
    return buffer.lookupTransform(parent, frame, ros::Time(0));
  } catch (const tf2::TransformException&) {
    return std::nullopt;  // tf was cleared meanwhile
  }
}

// The newest transform of the frame and of each above it.
std::vector<geometry_msgs::TransformStamped> linksAbove(const tf2_ros::Buffer& buffer,
                                                        const std::string& frame) {
  constexpr std::size_t kMost = 100;  // tf may have a loop for a moment
  std::vector<geometry_msgs::TransformStamped> links;
  for (auto link = toParent(buffer, frame); link && links.size() < kMost;
       link = toParent(buffer, link->header.frame_id))
    links.push_back(*link);
  return links;
}

std::string rootOf(const std::vector<geometry_msgs::TransformStamped>& links,
                   const std::string& frame) {
  return links.empty() ? frame : links.back().header.frame_id;
}

// What leads above both of two frames.
void dropCommon(std::vector<geometry_msgs::TransformStamped>& up,
                std::vector<geometry_msgs::TransformStamped>& down) {
  while (!up.empty() && !down.empty() && up.back().child_frame_id == down.back().child_frame_id) {
    up.pop_back();
    down.pop_back();
  }
}

// Of the transforms between two frames the one whose newest is oldest, where that is no static one; none where nothing
// joins them.
std::optional<geometry_msgs::TransformStamped> oldestBetween(const tf2_ros::Buffer& buffer,
                                                             const std::string& one,
                                                             const std::string& other) {
  auto up = linksAbove(buffer, one), down = linksAbove(buffer, other);
  if (rootOf(up, one) != rootOf(down, other)) return std::nullopt;
  dropCommon(up, down);
  up.insert(up.end(), down.begin(), down.end());
  std::optional<geometry_msgs::TransformStamped> oldest;
  for (const auto& link : up)
    if (!link.header.stamp.isZero() && (!oldest || link.header.stamp < oldest->header.stamp))
      oldest = link;
  return oldest;
}

// In the place of tf2's reason, which speaks of the arguments of a function and of extrapolation.
std::string reasonOf(const tf2_ros::Buffer& buffer, const std::string& target,
                     const std::string& source, const std::string& otherwise) {
  constexpr double kOld = 1.0;  // s
  std::string missing;
  for (const std::string& frame : {source, target})
    if (!buffer._frameExists(frame)) missing += (missing.empty() ? "'" : " or '") + frame + "'";
  if (!missing.empty()) return "nothing on /tf names the frame " + missing;
  const auto oldest = oldestBetween(buffer, source, target);
  const double age = oldest ? secondsBetween(oldest->header.stamp, ros::Time::now()) : 0.0;
  if (age < kOld) return otherwise;
  std::ostringstream text;
  text << "the newest from " << oldest->child_frame_id << " to " << oldest->header.frame_id
       << " is " << std::fixed << std::setprecision(1) << age << " s old";
  return text.str();
}

// Says once that something waits for tf: with a long limit nobody would know why nothing happens.
class LongWait {
 public:
  void tell(const std::string& why) {
    if (told_ || std::chrono::steady_clock::now() < due_) return;
    told_ = true;
    ROS_WARN_STREAM("Waiting for tf: " << why);
  }

 private:
  const std::chrono::steady_clock::time_point due_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(1);
  bool told_ = false;
};

}  // namespace

Pose FrameLookup::poseIn(const std::string& frame, const geometry_msgs::PoseStamped& pose,
                         const std::string& map_frame, double limit, const StopToken& stop) const {
  const std::string source = frameInMap(pose.header.frame_id, map_frame);
  const Pose level = poseFromMessage(pose.pose);
  if (source == frame) return level;
  const auto transform = waitFor(frame, source, pose.header.stamp, limit, stop);
  geometry_msgs::PoseStamped moved;
  tf2::doTransform(pose, moved, transform);
  Pose result;
  result.position = {moved.pose.position.x, moved.pose.position.y, moved.pose.position.z};
  result.yaw = yawOf(moved.pose.orientation);
  return result;
}

Pose FrameLookup::poseOf(const std::string& vehicle, const std::string& frame, double limit,
                         const StopToken& stop, std::optional<double> max_age) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit);
  const std::string source = frameName(vehicle);
  const auto latest = waitFor(frame, source, ros::Time(0), limit, stop);
  LongWait wait;
  while (max_age) {
    try {
      return recentPoseOf(source, frame, ros::Time::now(), *max_age).pose;
    } catch (const TransformError& error) {
      if (std::chrono::steady_clock::now() >= end) throw;
      wait.tell(error.what());
    }
    if (stop.reason() != StopReason::NONE) throw Stopped(stop.reason());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return poseOfTransform(latest.transform);
}

geometry_msgs::TransformStamped FrameLookup::waitFor(const std::string& target,
                                                     const std::string& source,
                                                     const ros::Time& stamp, double limit,
                                                     const StopToken& stop) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit);
  LongWait wait;
  while (true) {
    try {
      return transform(target, source, stamp);
    } catch (const TransformError& error) {
      const std::string why = sentence(target, source, stamp, error.what());
      if (std::chrono::steady_clock::now() >= end) throw TransformError(why);
      wait.tell(why);
    }
    if (stop.reason() != StopReason::NONE) throw Stopped(stop.reason());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

geometry_msgs::TransformStamped FrameLookup::transform(const std::string& target,
                                                       const std::string& source,
                                                       const ros::Time& stamp) const {
  try {
    return buffer_.lookupTransform(target, source, stamp);
  } catch (const tf2::TransformException& error) {
    throw TransformError(reasonOf(buffer_, target, source, error.what()));
  } catch (const std::runtime_error&) {  // roscpp's: times that are 2^31 s apart have no difference
    throw TransformError("its time is not within decades of those that /tf has");
  }
}

FrameLookup::RecentPose FrameLookup::recentPoseOf(const std::string& vehicle,
                                                  const std::string& frame, const ros::Time& now,
                                                  double max_age) const {
  const std::string pose = "the pose of " + vehicle + " in " + frame;
  geometry_msgs::TransformStamped found;
  try {
    found = transform(frame, vehicle);
  } catch (const TransformError& error) {
    throw TransformError(pose + " is not known: " + error.what());
  }
  if (found.header.stamp.isZero()) return {poseOfTransform(found.transform), 0.0};
  const double age = secondsBetween(found.header.stamp, now);
  if (std::abs(age) > max_age) throw TransformError(pose + " is " + std::to_string(age) + " s old");
  return {poseOfTransform(found.transform), age};
}

void FrameLookup::checkKnown(const std::string& frame, const std::string& vehicle) const {
  if (!buffer_._frameExists(frame) && buffer_._frameExists(vehicle))
    throw InputError("the frame '" + frame + "' is not known to tf");
}

Path FrameLookup::pathIn(const nav_msgs::Path& message, const std::string& vehicle,
                         const std::string& map_frame, double max_age) const {
  const std::string frame = frameInMap(message.header.frame_id, map_frame);
  checkKnown(frame, vehicle);
  nav_msgs::Path path = message;
  path.header.frame_id = frame;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    geometry_msgs::PoseStamped& pose = path.poses[i];
    const std::string own = frameName(pose.header.frame_id);
    if (own.empty() || own == frame) continue;
    try {
      poseFromMessage(pose.pose);
      checkNotOlder(frame, own, ros::Time::now(), max_age);
      tf2::doTransform(pose.pose, pose.pose, transform(frame, own));
    } catch (const TransformError& error) {
      throw InputError("pose " + std::to_string(i + 1) +
                       " of the path cannot be transformed from '" + own + "' to '" + frame +
                       "': " + error.what());
    } catch (const InputError& error) {
      throw InputError("pose " + std::to_string(i + 1) + " of the path: " + error.what());
    }
  }
  return pathFromMessage(path);
}

std::string FrameLookup::commonFrame(const std::string& one, const std::string& other) const {
  const auto up = linksAbove(buffer_, one), down = linksAbove(buffer_, other);
  std::string common = rootOf(up, one);
  if (common != rootOf(down, other)) return "";
  for (auto a = up.rbegin(), b = down.rbegin();
       a != up.rend() && b != down.rend() && a->child_frame_id == b->child_frame_id; ++a, ++b)
    common = a->child_frame_id;
  return common;
}

std::vector<std::string> FrameLookup::framesBetween(const std::string& one,
                                                    const std::string& other) const {
  auto up = linksAbove(buffer_, one), down = linksAbove(buffer_, other);
  if (rootOf(up, one) != rootOf(down, other)) return {};
  dropCommon(up, down);
  std::vector<std::string> frames = {one, other};
  for (const auto* links : {&up, &down})
    for (const geometry_msgs::TransformStamped& link : *links)
      frames.push_back(link.header.frame_id);
  return frames;
}

bool FrameLookup::movesWith(const std::string& vehicle, const std::string& frame) const {
  if (frame == vehicle) return true;
  for (const geometry_msgs::TransformStamped& link : linksAbove(buffer_, frame)) {
    if (!link.header.stamp.isZero()) return false;
    if (link.header.frame_id == vehicle) return true;
  }
  return false;
}

void FrameLookup::checkNotOlder(const std::string& to, const std::string& from,
                                const ros::Time& now, double max_age) const {
  if (from == to) return;
  const ros::Time stamp = transform(to, from).header.stamp;
  const double age = stamp.isZero() ? 0.0 : secondsBetween(stamp, now);
  if (age > max_age)
    throw TransformError("the transform from " + from + " to " + to + " is " + std::to_string(age) +
                         " s old");
}

std::vector<Eigen::Vector3d> FrameLookup::pointsIn(const std::string& to, const std::string& from,
                                                   std::vector<Eigen::Vector3d> points,
                                                   const ros::Time& stamp) const {
  if (from == to) return points;
  try {
    geometry_msgs::TransformStamped moving = transform(to, from);
    if (!stamp.isZero() && stamp < moving.header.stamp) moving = transform(to, from, stamp);
    for (Eigen::Vector3d& point : points) {
      geometry_msgs::Point message;
      message.x = point.x();
      message.y = point.y();
      message.z = point.z();
      tf2::doTransform(message, message, moving);
      point = {message.x, message.y, message.z};
      if (!point.allFinite()) throw TransformError("it leads beyond all numbers");
    }
    return points;
  } catch (const TransformError& error) {
    throw TransformError("no transform from '" + from + "' to '" + to + "': " + error.what());
  }
}

}  // namespace grid_path_planner::nodes
