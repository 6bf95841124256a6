// A cloud, its camera_info and a path as local_planner hears them, as far as the pilot's commands.
#include <nav_msgs/Path.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include <cmath>
#include <optional>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/avoidance/cloud_frames.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr std::uint32_t kMostPixels = 4096;
const ros::Time kNowOfClouds(1000, 0);

std::vector<std::string> seedsOfFlights() {
  sensor_msgs::CameraInfo camera;
  camera.header.frame_id = "camera";
  camera.width = 2;
  camera.height = 2;
  camera.K = {2.0, 0.0, 0.5, 0.0, 2.0, 0.5, 0.0, 0.0, 1.0};
  nav_msgs::Path path;
  path.header.frame_id = "map";
  path.poses.resize(1);
  path.poses[0].pose.position.x = 3.0;
  path.poses[0].pose.orientation.w = 1.0;
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = "camera";
  cloud.header.stamp = kNowOfClouds;
  cloud.width = cloud.height = 2;
  cloud.point_step = 12;
  cloud.row_step = 24;
  for (int axis = 0; axis < 3; ++axis) {
    sensor_msgs::PointField field;
    field.name = std::string(1, static_cast<char>('x' + axis));
    field.offset = static_cast<std::uint32_t>(4 * axis);
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.data.assign(48, 64);
  sensor_msgs::CameraInfo blind = camera;
  blind.K[0] = 4.450147717014403e-308;
  return {bytesOf(camera) + bytesOf(path) + bytesOf(cloud),
          bytesOf(blind) + bytesOf(path) + bytesOf(cloud)};
}

// As the node takes it, of a camera that tf has in the vehicle's middle; none where it is refused.
std::optional<avoidance::Frame> frameFrom(const sensor_msgs::CameraInfo& camera,
                                          sensor_msgs::PointCloud2 cloud) {
  cloud.header.stamp = kNowOfClouds;
  std::optional<avoidance::Frame> frame;
  mayRefuse([&] { frame = nodes::frameOf(cloud, Eigen::Isometry3d::Identity(), camera, {}); });
  return frame;
}

FUZZ_TARGET(local_planner_messages, seedsOfFlights) {
  Messages messages(input);
  const auto camera = messages.next<sensor_msgs::CameraInfo>();
  const auto path = messages.next<nav_msgs::Path>();
  const auto cloud = messages.next<sensor_msgs::PointCloud2>();
  if (!camera || !path || !cloud || std::uint64_t{cloud->width} * cloud->height > kMostPixels)
    return;
  avoidance::Pilot pilot;
  mayRefuse([&] {
    std::vector<Eigen::Vector3d> points;
    for (const path::Pose& pose : nodes::pathFromMessage(*path).poses)
      points.push_back(pose.position);
    pilot.setPath(points);
  });
  const std::optional<avoidance::Frame> frame = frameFrom(*camera, *cloud);
  for (int i = 0; i < 2; ++i) {
    avoidance::PilotInput given;
    given.time = kNowOfClouds.toSec() + 0.1 * i;
    given.pose = avoidance::VehiclePose{};
    if (frame) given.frame = &*frame;
    const base::BodyVelocity command = pilot.update(given).velocity;
    mustHold(command.isFinite(), "commands are finite");
    mustHold(std::hypot(command.surge, command.sway) <= pilot.options().max_speed + 1e-9,
             "the speed keeps its limit");
  }
}

}  // namespace
}  // namespace grid_path_planner::fuzz
