#include "ros/simulation/image_camera_publisher.h"

#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <cmath>

#include "ros/common/guarded_queue.h"
#include "ros/simulation/camera_info.h"

namespace grid_path_planner::nodes {

using base::StopSource;
using base::StopToken;
using simulation::ImageCameraOptions;
using simulation::VehicleState;
using simulation::World;

ImageCameraPublisher::ImageCameraPublisher(ros::NodeHandle& nh, const World& world,
                                           const ImageCameraOptions& options)
    : camera_(world, options),
      period_ns_(std::llround(1e9 / options.rate)),
      images_(nh.advertise<sensor_msgs::Image>("camera/image_raw", 1)),
      info_(nh.advertise<sensor_msgs::CameraInfo>("camera/camera_info", 10)),
      renderer_([](const std::string& error) { tellGivenUp("An image of the camera", error); }) {}

bool ImageCameraPublisher::wants(std::int64_t time_ns) {
  if (time_ns < next_ns_) return false;
  next_ns_ = (time_ns / period_ns_ + 1) * period_ns_;
  if (images_.getNumSubscribers() == 0 && info_.getNumSubscribers() == 0) return false;
  return !task_ || task_->waitFor(std::chrono::seconds(0));
}

void ImageCameraPublisher::capture(const VehicleState& state, std::int64_t time_ns,
                                   const Header& header) {
  const Eigen::Isometry3d map_from_optical = mapFromBase(state) * camera_.baseFromOptical();
  const auto frame = static_cast<std::uint64_t>(time_ns / period_ns_);
  task_ = renderer_.post([this, map_from_optical, frame, header](const StopSource& stop) {
    render(map_from_optical, frame, header, stop.token());
  });
}

void ImageCameraPublisher::render(const Eigen::Isometry3d& map_from_optical, std::uint64_t frame,
                                  const Header& header, const StopToken& stop) {
  if (images_.getNumSubscribers() == 0) return publishInfo(header);
  const auto image = boost::make_shared<sensor_msgs::Image>();
  try {
    camera_.render(map_from_optical, frame, image->data, stop);
  } catch (const base::Stopped&) {
    return;  // the camera ends
  }
  image->header.frame_id = header.frame;
  image->header.stamp = header.stamp;
  image->width = static_cast<std::uint32_t>(options().width);
  image->height = static_cast<std::uint32_t>(options().height);
  image->encoding = sensor_msgs::image_encodings::RGB8;
  image->step = 3 * image->width;
  publishInfo(header);
  images_.publish(image);
}

void ImageCameraPublisher::publishInfo(const Header& header) {
  sensor_msgs::CameraInfo info =
      cameraInfoOf(camera_.intrinsics(), options().width, options().height);
  info.header.frame_id = header.frame;
  info.header.stamp = header.stamp;
  info_.publish(info);
}

}  // namespace grid_path_planner::nodes
