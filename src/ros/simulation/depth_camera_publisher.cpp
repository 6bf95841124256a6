#include "ros/simulation/depth_camera_publisher.h"

#include <chrono>
#include <cmath>
#include <cstring>

#include "grid_path_planner/base/options.h"
#include "ros/guard/guarded_queue.h"
#include "ros/simulation/camera_info.h"
#include "ros/simulation/transform_message.h"
#include "simulation/camera/pinhole.h"

namespace grid_path_planner::nodes {

using base::sameOptions;
using base::StopSource;
using base::StopToken;
using simulation::DepthCameraOptions;
using simulation::VehicleState;
using simulation::World;

namespace {

Eigen::Isometry3d baseFromCamera(const DepthCameraOptions& o) {
  return Eigen::Translation3d(o.x, o.y, o.z) * Eigen::AngleAxisd(o.yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(o.pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(o.roll, Eigen::Vector3d::UnitX());
}

sensor_msgs::PointCloud2 emptyCloud(const DepthCameraOptions& options) {
  sensor_msgs::PointCloud2 cloud;
  cloud.width = static_cast<std::uint32_t>(options.width);
  cloud.height = static_cast<std::uint32_t>(options.height);
  for (const char* name : {"x", "y", "z"}) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(cloud.fields.size() * sizeof(float));
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.point_step = 3 * sizeof(float);
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.is_dense = false;
  return cloud;
}

}  // namespace

std::vector<geometry_msgs::TransformStamped> cameraTransforms(const DepthCameraOptions& options,
                                                              const CameraFrameNames& frames) {
  return {transformOf(frames.base, frames.camera, baseFromCamera(options)),
          transformOf(frames.camera, frames.optical, simulation::opticalFrame())};
}

DepthCameraPublisher::DepthCameraPublisher(ros::NodeHandle& nh, const World& world,
                                           const DepthCameraOptions& options,
                                           const CameraFrameNames& frames)
    : camera_(world, options),
      frames_(frames),
      period_ns_(std::llround(1e9 / options.rate)),
      points_publisher_(nh.advertise<sensor_msgs::PointCloud2>("depth_camera/points", 10)),
      info_publisher_(nh.advertise<sensor_msgs::CameraInfo>("depth_camera/camera_info", 10)),
      renderer_([](const std::string& error) { tellGivenUp("A picture of the camera", error); }) {}

bool DepthCameraPublisher::same(const DepthCameraOptions& options,
                                const CameraFrameNames& frames) const {
  return sameOptions(options, camera_.options()) && frames.base == frames_.base &&
         frames.camera == frames_.camera && frames.optical == frames_.optical;
}

bool DepthCameraPublisher::busy() const {
  return task_ && !task_->waitFor(std::chrono::seconds(0));
}

void DepthCameraPublisher::capture(const VehicleState& state, std::int64_t time_ns,
                                   const ros::Time& stamp) {
  const std::int64_t frame = time_ns / period_ns_;
  next_ns_ = (frame + 1) * period_ns_;
  if (points_publisher_.getNumSubscribers() == 0 && info_publisher_.getNumSubscribers() == 0)
    return;
  const Shot shot{mapFromBase(state) * camera_.baseFromOptical(), static_cast<std::uint64_t>(frame),
                  stamp};
  task_ = renderer_.post([this, shot](const StopSource& stop) {
    try {
      render(shot, stop.token());
    } catch (const base::Stopped&) {  // the camera ends
    }
  });
}

// In the renderer's thread.
void DepthCameraPublisher::render(const Shot& shot, const StopToken& stop) {
  const DepthCameraOptions& o = camera_.options();
  sensor_msgs::CameraInfo info = cameraInfoOf(camera_.intrinsics(), o.width, o.height);
  info.header.frame_id = frames_.optical;
  info.header.stamp = shot.stamp;
  info_publisher_.publish(info);
  if (points_publisher_.getNumSubscribers() == 0) return;
  std::vector<float> points;
  camera_.render(shot.map_from_optical, shot.frame, points, {}, stop);
  const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>(emptyCloud(o));
  cloud->header = info.header;
  cloud->data.resize(points.size() * sizeof(float));
  std::memcpy(cloud->data.data(), points.data(), cloud->data.size());
  points_publisher_.publish(cloud);
}

}  // namespace grid_path_planner::nodes
