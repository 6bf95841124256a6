// An image and a calibration, as marker_localizer takes them.
#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "ros/localization/camera_messages.h"
#include "vision/marker_detection.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfImages() {
  sensor_msgs::Image image;
  image.width = 8;
  image.height = 6;
  image.step = 24;
  image.encoding = "rgb8";
  image.data.assign(144, 100);
  std::vector<std::string> seeds = {bytesOf(image)};
  image.encoding = "bayer_gbrg8";
  image.step = 8;
  image.data.resize(48);
  seeds.push_back(bytesOf(image));
  return seeds;
}

FUZZ_TARGET(image_message, seedsOfImages) {
  const auto image = messageOf<sensor_msgs::Image>(input);
  if (!image) return;
  mayRefuse([&] {
    const auto grey = vision::greyPixels(nodes::encodedImageOf(*image));
    mustHold(grey.size() == std::size_t{image->width} * image->height, "a byte for each pixel");
    vision::detectMarkers({grey.data(), static_cast<int>(image->width),
                           static_cast<int>(image->height), image->width},
                          {});
  });
}

std::vector<std::string> seedsOfCalibrations() {
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.01);
  info.K = {468.0, 0.0, 319.5, 0.0, 468.0, 239.5, 0.0, 0.0, 1.0};
  return {bytesOf(info)};
}

FUZZ_TARGET(camera_info_message, seedsOfCalibrations) {
  const auto info = messageOf<sensor_msgs::CameraInfo>(input);
  if (!info) return;
  mayRefuse([&] {
    const vision::CameraCalibration c = nodes::calibrationOf(*info);
    mustHold(c.width > 0 && c.height > 0 && c.fx > 0.0 && c.fy > 0.0, "a camera sees something");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
