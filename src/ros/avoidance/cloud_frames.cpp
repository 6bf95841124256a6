#include "ros/avoidance/cloud_frames.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/clock.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/messages/cloud_reader.h"

namespace grid_path_planner::nodes {

using avoidance::Frame;
using avoidance::PilotOptions;
using avoidance::Pinhole;
using base::InputError;

namespace {

// All topics share the memory of one.
InputRules cloudRules(const LocalPlannerOptions& options) {
  InputRules rules = rulesOf("local_planner", "points");
  rules.frames = {options.map_frame};
  rules.silent_after = options.pilot.cloud_timeout;
  rules.most_bytes /= cloudTopics(options).size();
  return rules;
}

void checkSize(const sensor_msgs::PointCloud2& cloud) {
  const std::size_t pixels = std::size_t{cloud.width} * cloud.height;
  if (pixels == 0) throw InputError("it holds no point");
  if (pixels > avoidance::kMostPixels)
    throw InputError("it has " + std::to_string(pixels) + " points, more than " +
                     std::to_string(avoidance::kMostPixels));
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

}  // namespace

Frame frameOf(const sensor_msgs::PointCloud2& cloud, const Eigen::Isometry3d& map_from_sensor,
              const std::optional<sensor_msgs::CameraInfo>& camera, const PilotOptions& options) {
  checkSize(cloud);
  Frame frame;
  frame.time = cloud.header.stamp.toSec();
  frame.map_from_sensor = map_from_sensor;
  frame.points = allPoints(cloud);
  frame.width = static_cast<int>(cloud.width);
  frame.height = static_cast<int>(cloud.height);
  frame.pinhole = pinholeOf(camera, cloud);
  if (isBlind(frame, options)) throw InputError("it holds no point within range_min and range_max");
  return frame;
}

CloudFrames::CloudFrames(const ros::NodeHandle& nh, const LocalPlannerOptions& options,
                         const FrameLookup& transforms) {
  const std::vector<std::string> topics = cloudTopics(options);
  sensors_.resize(topics.size());
  for (std::size_t i = 0; i < topics.size(); ++i) {
    Sensor& sensor = sensors_[i];
    sensor.clouds = std::make_unique<Clouds>(nh, topics[i], cloudRules(options), transforms,
                                             Clouds::OnReady{[] {}});
    sensor.camera_subscriber = subscribeChecked<sensor_msgs::CameraInfo>(
        nh, cameraTopic(topics[i]), 1,
        [&sensor](const sensor_msgs::CameraInfo& camera) { sensor.camera = camera; });
  }
}

void CloudFrames::setOptions(const LocalPlannerOptions& options) {
  for (Sensor& sensor : sensors_) sensor.clouds->setRules(cloudRules(options));
}

std::vector<Frame> CloudFrames::take(const PilotOptions& options) {
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const Sensor& sensor = sensors_[i];
    sensor.clouds->poll();
    while (sensor.clouds->useNext([&](const Clouds::Arrival& cloud) {
      Frame frame = frameOf(*cloud.message, cloud.poses[0], sensor.camera, options);
      frame.sensor = static_cast<int>(i);
      frames.push_back(std::move(frame));
    })) {
    }
  }
  std::stable_sort(frames.begin(), frames.end(),
                   [](const Frame& a, const Frame& b) { return a.time < b.time; });
  return frames;
}

std::optional<std::string> CloudFrames::problem() const {
  for (const Sensor& sensor : sensors_)
    if (auto why = sensor.clouds->problem()) return why;
  return std::nullopt;
}

double CloudFrames::age(const ros::Time& now) const {
  double oldest = 0.0;
  for (const Sensor& sensor : sensors_) {
    const ros::Time newest = sensor.clouds->newest();
    oldest = std::max(oldest, newest.isZero() ? std::numeric_limits<double>::infinity()
                                              : secondsBetween(newest, now));
  }
  return oldest;
}

void CloudFrames::addTo(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  for (const Sensor& sensor : sensors_) {
    const std::string& topic = sensor.clouds->topic();
    status.add(topic, sensor.clouds->problem().value_or("taken"));
    nodes::addTo(status, "clouds of " + topic, sensor.clouds->counts());
  }
}

}  // namespace grid_path_planner::nodes
