// The depth camera of a simulated vehicle as topics.
//
//   DepthCameraPublisher camera(nh, world, options, frames);
//   if (camera.due(time_ns)) {
//     if (camera.busy()) return;            // simulated time waits
//     camera.capture(vehicle.state(), time_ns, stamp);
//   }
//
//   depth_camera/points       sensor_msgs/PointCloud2, organised, x y z in the optical frame
//                             (REP 103), NaN where nothing was measured
//   depth_camera/camera_info  sensor_msgs/CameraInfo
//
// Guaranteed: nothing is rendered without a subscriber; rendering is done in a thread of its own, one
// image at a time, in the order of the stamps; images are due at whole multiples of 1 / rate of
// simulated time. Not guaranteed: that tf at the stamp arrives before the image; the caller sends it
// before `capture`.
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/simulation/depth_camera.h"
#include "grid_path_planner/simulation/vehicle.h"

namespace grid_path_planner::nodes {

struct CameraFrameNames {
  std::string base;
  std::string camera;   // x ahead, z up
  std::string optical;  // z ahead, y down
};

// base -> camera -> optical, without stamps.
std::vector<geometry_msgs::TransformStamped> cameraTransforms(
    const simulation::DepthCameraOptions& options, const CameraFrameNames& frames);

class DepthCameraPublisher {
 public:
  // Throws InputError as DepthCamera's constructor does. The destructor leaves the image that is being rendered unfinished.
  DepthCameraPublisher(ros::NodeHandle& nh, const simulation::World& world,
                       const simulation::DepthCameraOptions& options,
                       const CameraFrameNames& frames);
  // Whether this is the camera that these would give.
  bool same(const simulation::DepthCameraOptions& options, const CameraFrameNames& frames) const;

  // Whether an image is due at this simulated time, which never decreases.
  bool due(std::int64_t time_ns) const { return time_ns >= next_ns_; }
  // Whether the last image is still being rendered.
  bool busy() const;
  // Captures an image from the vehicle at `state`, if there are subscribers. Only when not busy.
  void capture(const simulation::VehicleState& state, std::int64_t time_ns, const ros::Time& stamp);

 private:
  struct Shot {
    Eigen::Isometry3d map_from_optical;
    std::uint64_t frame;
    ros::Time stamp;
  };

  void render(const Shot& shot, const base::StopToken& stop);

  simulation::DepthCamera camera_;
  CameraFrameNames frames_;
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
  ros::Publisher points_publisher_;
  ros::Publisher info_publisher_;
  std::shared_ptr<base::TaskQueue::Task> task_;  // of the last image
  base::TaskQueue renderer_;                     // ends first
};

}  // namespace grid_path_planner::nodes
