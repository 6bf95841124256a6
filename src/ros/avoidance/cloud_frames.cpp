#include "ros/avoidance/cloud_frames.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "grid_path_planner/base/errors.h"
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

Frame frameOf(const sensor_msgs::PointCloud2& cloud, const Eigen::Isometry3d& map_from_sensor) {
  Frame frame;
  frame.time = cloud.header.stamp.toSec();
  frame.map_from_sensor = map_from_sensor;
  frame.points = allPoints(cloud);
  frame.width = static_cast<int>(cloud.width);
  frame.height = static_cast<int>(cloud.height);
  return frame;
}

// Of the same frame and size; anything else is of another camera.
std::optional<Pinhole> pinholeOf(const std::optional<sensor_msgs::CameraInfo>& camera,
                                 const sensor_msgs::PointCloud2& cloud) {
  if (!camera || camera->header.frame_id != cloud.header.frame_id || camera->width != cloud.width ||
      camera->height != cloud.height)
    return std::nullopt;
  const auto& k = camera->K;
  return Pinhole{k[0], k[4], k[2], k[5]};
}

std::string inBrackets(const std::string& text) {
  return text.empty() ? "" : " (" + text + ")";
}

}  // namespace

CloudFrames::CloudFrames(const std::vector<std::string>& topics) {
  for (const std::string& topic : topics) sensors_.push_back({topic});
}

void CloudFrames::setCamera(std::size_t topic, const sensor_msgs::CameraInfo& camera) {
  sensors_[topic].camera = camera;
}

void CloudFrames::clear() {
  for (Sensor& sensor : sensors_) {
    sensor.waiting.reset();
    sensor.newest.reset();
    sensor.problem.clear();
  }
}

// tf2 throws at the end of what ROS time can hold, and no transform would come before such a stamp.
bool CloudFrames::isUseless(Sensor& sensor, const ros::Time& now) {
  if (!sensor.waiting) return true;
  const double ahead = secondsBetween(now, sensor.waiting->header.stamp);
  if (ahead > kLongestWait)
    sensor.problem =
        "the newest cloud is stamped " + std::to_string(ahead) + " s ahead of ROS time";
  else if (sensor.waiting->width == 0 || sensor.waiting->height == 0)
    sensor.problem = "the newest cloud holds no point";
  else
    return false;
  sensor.waiting.reset();
  return true;
}

std::optional<Frame> CloudFrames::next(Sensor& sensor, const FrameTransforms& transforms,
                                       const std::string& map_frame, const ros::Time& now) {
  if (isUseless(sensor, now)) return std::nullopt;
  const sensor_msgs::PointCloud2& cloud = *sensor.waiting;
  try {
    const auto transform =
        transforms.transform(map_frame, cloud.header.frame_id, cloud.header.stamp);
    Frame frame = frameOf(cloud, poseOf(transform.transform));
    frame.pinhole = pinholeOf(sensor.camera, cloud);
    sensor.newest = cloud.header.stamp;
    sensor.waiting.reset();
    sensor.problem.clear();
    return frame;
  } catch (const TransformError& error) {
    sensor.problem = error.what();
    if (secondsBetween(cloud.header.stamp, now) > kLongestWait) sensor.waiting.reset();
  } catch (const base::InputError& error) {
    sensor.problem = error.what();
    sensor.waiting.reset();
  }
  return std::nullopt;
}

std::vector<Frame> CloudFrames::take(const FrameTransforms& transforms,
                                     const std::string& map_frame, const ros::Time& now) {
  std::vector<Frame> frames;
  for (Sensor& sensor : sensors_)
    if (auto frame = next(sensor, transforms, map_frame, now)) frames.push_back(std::move(*frame));
  std::stable_sort(frames.begin(), frames.end(),
                   [](const Frame& a, const Frame& b) { return a.time < b.time; });
  return frames;
}

std::string CloudFrames::silence(const ros::Time& now, double timeout) const {
  for (const Sensor& sensor : sensors_) {
    if (!sensor.newest)
      return "no cloud that can be used has come yet on " + sensor.topic +
             inBrackets(sensor.problem);
    const double age = secondsBetween(*sensor.newest, now);
    if (age <= timeout) continue;
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%.2f", age);
    return "the newest cloud of " + sensor.topic + " is " + seconds + " s old" +
           inBrackets(sensor.problem);
  }
  return "";
}

std::string CloudFrames::problems() const {
  std::string all;
  for (const Sensor& sensor : sensors_)
    if (!sensor.problem.empty())
      all += (all.empty() ? "" : "; ") + sensor.topic + ": " + sensor.problem;
  return all;
}

}  // namespace grid_path_planner::nodes
