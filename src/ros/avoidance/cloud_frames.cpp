#include "ros/avoidance/cloud_frames.h"

#include <cmath>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/common/clock.h"
#include "ros/common/incoming/cloud_reader.h"

namespace grid_path_planner::nodes {

using avoidance::Frame;
using avoidance::Pinhole;

namespace {

constexpr double kLongestWait = 1.0;  // s for tf

Eigen::Isometry3d poseOf(const geometry_msgs::Transform& transform) {
  const auto& q = transform.rotation;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(
      Eigen::Vector3d(transform.translation.x, transform.translation.y, transform.translation.z));
  pose.rotate(Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized());
  return pose;
}

void checkSize(const sensor_msgs::PointCloud2& cloud) {
  const std::size_t pixels = std::size_t{cloud.width} * cloud.height;
  if (pixels > avoidance::kMostPixels)
    throw base::InputError("the newest cloud has " + std::to_string(pixels) +
                           " points, more than " + std::to_string(avoidance::kMostPixels));
}

Frame frameOf(const sensor_msgs::PointCloud2& cloud, const Eigen::Isometry3d& map_from_sensor) {
  Frame frame;
  frame.time = cloud.header.stamp.toSec();
  frame.map_from_sensor = map_from_sensor;
  frame.points = allPoints(cloud);
  frame.width = static_cast<int>(cloud.width);
  frame.height = static_cast<int>(cloud.height);
  return frame;
}

}  // namespace

void CloudFrames::add(const sensor_msgs::PointCloud2::ConstPtr& cloud) {
  waiting_ = cloud;
  waits_for_tf_ = false;
}

void CloudFrames::setCamera(const sensor_msgs::CameraInfo& camera) {
  camera_ = camera;
}

void CloudFrames::clear() {
  waiting_.reset();
  problem_.clear();
}

// Of the same frame and size; anything else is of another camera.
std::optional<Pinhole> CloudFrames::pinholeOf(const sensor_msgs::PointCloud2& cloud) const {
  if (!camera_ || frameName(camera_->header.frame_id) != frameName(cloud.header.frame_id) ||
      camera_->width != cloud.width || camera_->height != cloud.height)
    return std::nullopt;
  const auto& k = camera_->K;
  return Pinhole{k[0], k[4], k[2], k[5]};
}

// tf2 throws at the end of what ROS time can hold, and no transform would come before such a stamp; it
// takes a stamp of 0 for the latest.
bool CloudFrames::isOfAnotherTime(const ros::Time& now) {
  const double ahead = secondsBetween(now, waiting_->header.stamp);
  if (std::abs(ahead) <= kLongestWait) return false;
  if (!waits_for_tf_)
    problem_ = "the newest cloud is stamped " + std::to_string(std::abs(ahead)) + " s " +
               (ahead > 0.0 ? "ahead of" : "before") + " ROS time";
  waiting_.reset();
  return true;
}

std::optional<Frame> CloudFrames::next(const FrameTransforms& transforms,
                                       const std::string& map_frame, const ros::Time& now) {
  if (!waiting_ || isOfAnotherTime(now)) return std::nullopt;
  const sensor_msgs::PointCloud2& cloud = *waiting_;
  try {
    checkSize(cloud);
    const auto transform =
        transforms.transform(map_frame, frameName(cloud.header.frame_id), cloud.header.stamp);
    Frame frame = frameOf(cloud, poseOf(transform.transform));
    frame.pinhole = pinholeOf(cloud);
    waiting_.reset();
    problem_.clear();
    return frame;
  } catch (const TransformError& error) {
    problem_ = error.what();
    waits_for_tf_ = true;
  } catch (const base::InputError& error) {
    problem_ = error.what();
    waiting_.reset();
  }
  return std::nullopt;
}

}  // namespace grid_path_planner::nodes
