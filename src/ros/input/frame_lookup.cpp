#include "ros/input/frame_lookup.h"

#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iomanip>
#include <optional>
#include <sstream>
#include <thread>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/clock.h"
#include "ros/input/foreign_rules.h"
#include "ros/messages/pose_reading.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::Stopped;
using base::StopReason;
using base::StopToken;
using path::Path;
using path::Pose;

namespace {

// s, that localization stamps ahead so that nobody waits for it, and clocks of nodes may differ by.
constexpr double kMostAheadOfStanding = 10.0;

// That of the x axis in the horizontal plane.
double yawOf(const Eigen::Matrix3d& rotation) {
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

std::string ageText(double seconds) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << seconds << " s";
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
  return "the newest from " + oldest->child_frame_id + " to " + oldest->header.frame_id + " is " +
         ageText(age) + " old";
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

// Tries again until it has a transform, `by` has waited, or is stopped.
Placed waited(const Placing& by, const std::function<Placed()>& now) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(by.wait);
  LongWait wait;
  while (true) {
    try {
      return now();
    } catch (const TransformError& error) {
      if (std::chrono::steady_clock::now() >= end) throw;
      wait.tell(error.what());
    }
    if (by.stop.reason() != StopReason::NONE) throw Stopped(by.stop.reason());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

std_msgs::Header headerOf(const std::string& frame, const ros::Time& stamp) {
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp = stamp;
  return header;
}

std::string sourceOf(const std_msgs::Header& header, const Placing& by) {
  return frameInMap(header.frame_id, by.map_frame.empty() ? by.into : by.map_frame);
}

// Throws InputError.
Pose poseOf(const geometry_msgs::Pose& message, const Placed& frame, const Placing& by) {
  static ToldOnce told;
  const PoseReading read = readPose(message, by.zero_heading);
  ROS_WARN_STREAM_COND(read.told && told.isNew(read.told),
                       "A pose that was given to this node: " << read.told);
  Pose pose = read.pose;
  if (!frame.pose.matrix().isIdentity(0.0)) {
    const auto& q = message.orientation;
    const Eigen::Quaterniond turn(q.w, q.x, q.y, q.z);
    pose.position = frame.pose * pose.position;
    if (!std::isnan(pose.yaw))
      pose.yaw = yawOf(frame.pose.linear() * turn.normalized().toRotationMatrix());
  }
  checkCoordinates(pose.position);
  return pose;
}

}  // namespace

Eigen::Isometry3d isometryOf(const geometry_msgs::Transform& transform) {
  const auto& t = transform.translation;
  const auto& q = transform.rotation;
  return Eigen::Translation3d(t.x, t.y, t.z) * Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

Pose Placed::level() const {
  return {pose.translation(), yawOf(pose.linear())};
}

Placed FrameLookup::place(const std_msgs::Header& header, const Placing& by) const {
  const std::string source = sourceOf(header, by);
  if (source == by.into) return {};
  return waited(by, [&] { return placedNow(source, header.stamp, by); });
}

Placed FrameLookup::placeVehicle(const Placing& by) const {
  return place(headerOf(by.vehicle, ros::Time()), by);
}

Pose FrameLookup::place(const geometry_msgs::PoseStamped& pose, const Placing& by) const {
  readPose(pose.pose, by.zero_heading);  // one that is none waits for nothing
  return poseOf(pose.pose, place(pose.header, by), by);
}

std::vector<Eigen::Vector3d> FrameLookup::place(std::vector<Eigen::Vector3d> points,
                                                const std_msgs::Header& header,
                                                const Placing& by) const {
  if (sourceOf(header, by) == by.into) return points;
  const Placed frame = place(header, by);
  for (Eigen::Vector3d& point : points) {
    point = frame.pose * point;
    if (!point.allFinite())
      throw TransformError("the transform from " + header.frame_id + " to " + by.into +
                           " leads beyond all numbers");
  }
  return points;
}

void FrameLookup::checkStands(const std::string& frame, const Placing& by) const {
  if (!by.vehicle.empty() && movesWith(by.vehicle, frame))
    throw InputError("the path is in the frame '" + frame + "', which moves with '" + by.vehicle +
                     "': nobody arrives there");
}

Path FrameLookup::place(const nav_msgs::Path& message, const Placing& by) const {
  const std::string frame = sourceOf(message.header, by);
  checkStands(frame, by);
  if (!buffer_._frameExists(frame) && buffer_._frameExists(by.vehicle))
    throw InputError("the frame '" + frame + "' is not known to tf");
  const Placed of_path = place(message.header, by);
  Path path;
  path.frame_id = by.into;
  path.poses.reserve(message.poses.size());
  for (const geometry_msgs::PoseStamped& pose : message.poses) {
    const std::string number = "pose " + std::to_string(path.poses.size() + 1) + " of the path";
    const std::string own = frameInMap(pose.header.frame_id, frame);
    try {
      path.poses.push_back(own == frame ? poseOf(pose.pose, of_path, by) : place(pose, by));
    } catch (const TransformError& error) {
      throw InputError(number + " cannot be transformed from '" + own + "' to '" + by.into +
                       "': " + error.what());
    } catch (const InputError& error) {
      throw InputError(number + ": " + error.what());
    }
  }
  path::lookAlongPath(path);
  return path;
}

Path FrameLookup::place(Path path, const Placing& by) const {
  checkStands(path.frame_id, by);
  const Placed frame = place(headerOf(path.frame_id, ros::Time()), by);
  const double turn = yawOf(frame.pose.linear());
  for (Pose& pose : path.poses) {
    if (turn != 0.0) pose.yaw = std::remainder(pose.yaw + turn, 2.0 * M_PI);
    pose.position = frame.pose * pose.position;
    checkCoordinates(pose.position);
  }
  path.frame_id = by.into;
  return path;
}

Placed FrameLookup::placedNow(const std::string& frame, const ros::Time& stamp,
                              const Placing& by) const {
  const bool moves = by.moving == Moving::AT_STAMP ||
                     (by.moving == Moving::WITH_VEHICLE && movesWith(by.vehicle, frame));
  const ros::Time at = moves ? stamp : ros::Time();
  const geometry_msgs::TransformStamped found = nearest(frame, at, by);
  Placed placed{isometryOf(found.transform), found.header.stamp, 0.0};
  if (placed.stamp.isZero()) return placed;
  placed.age = secondsBetween(placed.stamp, ros::Time::now());
  const double off = at.isZero() ? placed.age : secondsBetween(placed.stamp, at);
  const double most_ahead = moves ? by.max_age : std::max(by.max_age, kMostAheadOfStanding);
  if (off <= by.max_age && -off <= most_ahead) return placed;
  const std::string what = frame == by.vehicle ? "the pose of " + frame + " in "
                                               : "the transform from " + frame + " to ";
  throw TransformError(what + by.into + " is " +
                       (off > 0.0 ? ageText(off) + " old" : "stamped " + ageText(-off) + " ahead") +
                       (at.isZero() ? "" : " at the stamp"));
}

// The transform at `stamp`; the newest where that is 0, ahead of all that tf has, or as near to it as `by` asks for.
geometry_msgs::TransformStamped FrameLookup::nearest(const std::string& frame,
                                                     const ros::Time& stamp,
                                                     const Placing& by) const {
  try {
    const geometry_msgs::TransformStamped newest = transform(by.into, frame);
    const ros::Time& last = newest.header.stamp;
    if (last.isZero() || stamp.isZero() || stamp >= last) return newest;
    try {
      return transform(by.into, frame, stamp);
    } catch (const TransformError&) {
      if (secondsBetween(stamp, last) <= by.max_age) return newest;
      throw;
    }
  } catch (const TransformError& error) {
    std::ostringstream text;
    if (frame == by.vehicle)
      text << "the pose of " << frame << " in " << by.into << " is not known";
    else
      text << "no transform from " << frame << " to " << by.into;
    if (!stamp.isZero()) text << " at " << stamp;
    throw TransformError(text.str() + ": " + error.what());
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

}  // namespace grid_path_planner::nodes
