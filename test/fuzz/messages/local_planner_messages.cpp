// A cloud, its camera_info and a path as local_planner hears them, as far as the pilot's commands.
#include <nav_msgs/Path.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include <cmath>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/common/incoming/cloud_reader.h"

namespace grid_path_planner::fuzz {
namespace {

constexpr std::uint32_t kMostPixels = 4096;

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
  return {bytesOf(camera) + bytesOf(path) + bytesOf(cloud)};
}

// Splits where the first two messages of the seed end; what does not fit is no message.
FUZZ_TARGET(local_planner_messages, seedsOfFlights) {
  sensor_msgs::CameraInfo shape;
  shape.header.frame_id = "camera";
  const std::size_t camera_end = bytesOf(shape).size();
  nav_msgs::Path route;
  route.header.frame_id = "map";
  route.poses.resize(1);
  const std::size_t path_end = camera_end + bytesOf(route).size();
  if (input.size() < path_end) return;
  const auto camera = messageOf<sensor_msgs::CameraInfo>(input.substr(0, camera_end));
  const auto path = messageOf<nav_msgs::Path>(input.substr(camera_end, path_end - camera_end));
  const auto cloud = messageOf<sensor_msgs::PointCloud2>(input.substr(path_end));
  if (!camera || !path || !cloud || std::uint64_t{cloud->width} * cloud->height > kMostPixels)
    return;
  avoidance::Pilot pilot;
  mayRefuse([&] {
    std::vector<Eigen::Vector3d> points;
    for (const path::Pose& pose : nodes::pathFromMessage(*path).poses)
      points.push_back(pose.position);
    pilot.setPath(points);
  });
  avoidance::Frame frame;
  mayRefuse([&] { frame.points = nodes::allPoints(*cloud); });
  frame.width = static_cast<int>(cloud->width);
  frame.height = static_cast<int>(cloud->height);
  frame.pinhole = avoidance::Pinhole{camera->K[0], camera->K[4], camera->K[2], camera->K[5]};
  for (int i = 0; i < 2; ++i) {
    avoidance::PilotInput given;
    given.time = frame.time = 0.1 * i;
    given.pose = avoidance::VehiclePose{};
    given.frame = &frame;
    const base::BodyVelocity command = pilot.update(given).velocity;
    mustHold(command.isFinite(), "commands are finite");
    mustHold(std::hypot(command.surge, command.sway) <= pilot.options().max_speed + 1e-9,
             "the speed keeps its limit");
  }
}

}  // namespace
}  // namespace grid_path_planner::fuzz
