// The image camera of a simulated vehicle as topics.
//
//   ImageCameraPublisher camera(nh, world, options, faults);
//   if (camera.wants(time_ns))                     // after tf of the same stamp was sent
//     camera.capture(vehicle.state(), time_ns, {frame, stamp});
//
//   camera/image_raw    sensor_msgs/Image, rgb8
//   camera/camera_info  sensor_msgs/CameraInfo
//
// Guaranteed: images are due at whole multiples of 1 / rate of simulated time and rendered in a thread of
// its own; nothing waits for one. Where the one before is still being rendered, an image is left out.
// Without a subscriber nothing is rendered. An image is published with the stamp of the pose that it shows.
// Pose and time decide what is in an image; the load of the machine only which ones there are. Of `faults` those of the
// camera are done to the images.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>
#include <sensor_msgs/Image.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/base/task_queue.h"
#include "grid_path_planner/simulation/vehicle.h"
#include "simulation/camera/image_camera.h"
#include "simulation/sensors/sensor_faults.h"

namespace grid_path_planner::nodes {

class ImageCameraPublisher {
 public:
  // Throws InputError as ImageCamera's constructor does.
  ImageCameraPublisher(ros::NodeHandle& nh, const simulation::World& world,
                       const simulation::ImageCameraOptions& options,
                       std::vector<simulation::SensorFault> faults);

  const simulation::ImageCameraOptions& options() const { return camera_.options(); }

  // Whether an image is due at this simulated time, which never decreases, is asked for, and can begin.
  // One that is due and cannot be is left out.
  bool wants(std::int64_t time_ns);

  struct Header {
    std::string frame;
    ros::Time stamp;
  };
  // Begins the image from the vehicle at `state`. Only where wanted.
  void capture(const simulation::VehicleState& state, std::int64_t time_ns, const Header& header);

 private:
  struct Shot {
    Eigen::Isometry3d map_from_optical;
    std::uint64_t frame;
    Header header;
    std::optional<simulation::FaultKind> fault;
  };
  void publish(const Shot& shot, const base::StopToken& stop);
  void fill(const Shot& shot, const base::StopToken& stop, std::vector<std::uint8_t>& pixels);
  void publishInfo(const Header& header);

  simulation::ImageCamera camera_;
  std::vector<simulation::SensorFault> faults_;
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
  ros::Publisher images_;
  ros::Publisher info_;
  sensor_msgs::ImageConstPtr last_;              // of the renderer; a frozen camera repeats it
  std::shared_ptr<base::TaskQueue::Task> task_;  // of the newest image
  base::TaskQueue renderer_;                     // ends first
};

}  // namespace grid_path_planner::nodes
