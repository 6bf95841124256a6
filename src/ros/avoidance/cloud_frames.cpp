#include "ros/avoidance/cloud_frames.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/clock.h"
#include "ros/messages/cloud_reader.h"

namespace grid_path_planner::nodes {

using avoidance::Frame;
using avoidance::isBlind;
using avoidance::PilotOptions;
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

// Of the same frame and size; anything else is of another camera.
std::optional<Pinhole> pinholeOf(const std::optional<sensor_msgs::CameraInfo>& camera,
                                 const sensor_msgs::PointCloud2& cloud) {
  if (!camera || frameName(camera->header.frame_id) != frameName(cloud.header.frame_id) ||
      camera->width != cloud.width || camera->height != cloud.height)
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

void CloudFrames::add(std::size_t topic, const sensor_msgs::PointCloud2::ConstPtr& cloud) {
  Sensor& sensor = sensors_[topic];
  if (!sensor.waiting) sensor.waiting = std::exchange(sensor.next, nullptr);
  (sensor.waiting ? sensor.next : sensor.waiting) = cloud;
}

void CloudFrames::setCamera(std::size_t topic, const sensor_msgs::CameraInfo& camera) {
  sensors_[topic].camera = camera;
}

void CloudFrames::clear() {
  for (Sensor& sensor : sensors_) {
    sensor.waiting.reset();
    sensor.next.reset();
    sensor.newest.reset();
    sensor.problem.clear();
  }
}

// Throws InputError for clouds that can never be used, TransformError where tf does not know their sensor
// (yet). tf2 throws at the end of what ROS time can hold, and no transform would come before such a stamp; it
// takes a stamp of 0 for the latest.
Frame CloudFrames::read(const Sensor& sensor, const sensor_msgs::PointCloud2& cloud,
                        const FrameLookup& transforms, const std::string& map_frame,
                        const ros::Time& now) {
  const double ahead = secondsBetween(now, cloud.header.stamp);
  if (std::abs(ahead) > kLongestWait)
    throw base::InputError("the newest cloud is stamped " + std::to_string(std::abs(ahead)) +
                           " s " + (ahead > 0.0 ? "ahead of" : "before") + " ROS time");
  if (cloud.width == 0 || cloud.height == 0)
    throw base::InputError("the newest cloud holds no point");
  checkSize(cloud);
  const std::string source = frameName(cloud.header.frame_id);
  if (source.empty()) throw base::InputError("the newest cloud names no frame");
  const auto transform = transforms.transform(map_frame, source, cloud.header.stamp);
  Frame frame = frameOf(cloud, poseOf(transform.transform));
  frame.pinhole = pinholeOf(sensor.camera, cloud);
  return frame;
}

// One that waits too long keeps the sentence of what it waited for.
std::optional<Frame> CloudFrames::next(Sensor& sensor, const FrameLookup& transforms,
                                       const std::string& map_frame, const ros::Time& now,
                                       const PilotOptions& options) {
  for (auto* cloud : {&sensor.waiting, &sensor.next}) {
    if (!*cloud) continue;
    try {
      Frame frame = read(sensor, **cloud, transforms, map_frame, now);
      if (isBlind(frame, options))
        throw base::InputError("the newest cloud holds no point within range_min and range_max");
      sensor.newest = std::min((*cloud)->header.stamp, now);  // stamps ahead prolong nothing
      sensor.problem.clear();
      cloud->reset();
      if (cloud == &sensor.next) sensor.waiting.reset();
      return frame;
    } catch (const TransformError& error) {
      sensor.problem = error.what();
    } catch (const base::InputError& error) {
      const bool is_old = secondsBetween((*cloud)->header.stamp, now) > kLongestWait;
      if (!is_old || sensor.problem.empty()) sensor.problem = error.what();
      cloud->reset();
    }
  }
  return std::nullopt;
}

std::vector<Frame> CloudFrames::take(const FrameLookup& transforms, const std::string& map_frame,
                                     const ros::Time& now, const PilotOptions& options) {
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    auto frame = next(sensors_[i], transforms, map_frame, now, options);
    if (!frame) continue;
    frame->sensor = static_cast<int>(i);
    frames.push_back(std::move(*frame));
  }
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

double CloudFrames::age(const ros::Time& now) const {
  double oldest = 0.0;
  for (const Sensor& sensor : sensors_)
    oldest = std::max(oldest, sensor.newest ? secondsBetween(*sensor.newest, now)
                                            : std::numeric_limits<double>::infinity());
  return oldest;
}

std::string CloudFrames::problems() const {
  std::string all;
  for (const Sensor& sensor : sensors_)
    if (!sensor.problem.empty())
      all += (all.empty() ? "" : "; ") + sensor.topic + ": " + sensor.problem;
  return all;
}

}  // namespace grid_path_planner::nodes
