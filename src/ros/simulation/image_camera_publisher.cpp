#include "ros/simulation/image_camera_publisher.h"

#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <cmath>
#include <utility>

#include "ros/guard/guarded_queue.h"
#include "ros/simulation/camera_info.h"

namespace grid_path_planner::nodes {

using base::StopSource;
using base::StopToken;
using simulation::FaultKind;
using simulation::ImageCameraOptions;
using simulation::SensorFault;
using simulation::VehicleState;
using simulation::World;

ImageCameraPublisher::ImageCameraPublisher(ros::NodeHandle& nh, const World& world,
                                           const ImageCameraOptions& options,
                                           std::vector<SensorFault> faults)
    : camera_(world, options),
      faults_(std::move(faults)),
      period_ns_(std::llround(1e9 / options.rate)),
      images_(nh.advertise<sensor_msgs::Image>("camera/image_raw", 1)),
      info_(nh.advertise<sensor_msgs::CameraInfo>("camera/camera_info", 10)),
      renderer_([](const std::string& error) { tellGivenUp("An image of the camera", error); }) {}

bool ImageCameraPublisher::wants(std::int64_t time_ns) {
  if (time_ns < next_ns_) return false;
  next_ns_ = (time_ns / period_ns_ + 1) * period_ns_;
  if (images_.getNumSubscribers() == 0 && info_.getNumSubscribers() == 0) return false;
  if (cameraFaultAt(faults_, time_ns) == FaultKind::CUT) return false;
  return !task_ || task_->waitFor(std::chrono::seconds(0));
}

void ImageCameraPublisher::capture(const VehicleState& state, std::int64_t time_ns,
                                   const Header& header) {
  const auto frame = static_cast<std::uint64_t>(time_ns / period_ns_);
  const Shot shot{mapFromBase(state) * camera_.baseFromOptical(), frame, header,
                  cameraFaultAt(faults_, time_ns)};
  task_ = renderer_.post([this, shot](const StopSource& stop) { publish(shot, stop.token()); });
}

// In the renderer's thread.
void ImageCameraPublisher::publish(const Shot& shot, const StopToken& stop) {
  if (images_.getNumSubscribers() == 0) return publishInfo(shot.header);
  const auto image = boost::make_shared<sensor_msgs::Image>();
  try {
    fill(shot, stop, image->data);
  } catch (const base::Stopped&) {
    return;  // the camera ends
  }
  image->header.frame_id = shot.header.frame;
  image->header.stamp = shot.header.stamp;
  image->width = static_cast<std::uint32_t>(options().width);
  image->height = static_cast<std::uint32_t>(options().height);
  image->encoding = sensor_msgs::image_encodings::RGB8;
  image->step = 3 * image->width;
  last_ = image;
  publishInfo(shot.header);
  images_.publish(image);
}

void ImageCameraPublisher::fill(const Shot& shot, const StopToken& stop,
                                std::vector<std::uint8_t>& pixels) {
  if (shot.fault == FaultKind::FROZEN && last_)
    pixels = last_->data;
  else if (shot.fault == FaultKind::NOT_A_NUMBER)
    pixels.assign(static_cast<std::size_t>(3 * options().width * options().height), 0);
  else
    camera_.render(shot.map_from_optical, shot.frame, pixels, stop);
}

void ImageCameraPublisher::publishInfo(const Header& header) {
  sensor_msgs::CameraInfo info =
      cameraInfoOf(camera_.intrinsics(), options().width, options().height);
  info.header.frame_id = header.frame;
  info.header.stamp = header.stamp;
  info_.publish(info);
}

}  // namespace grid_path_planner::nodes
