#include "ros/localization/camera_messages.h"

#include <algorithm>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {

using base::InputError;
using sensor_msgs::CameraInfo;

namespace {

constexpr std::uint32_t kLargestSide = 1 << 15;  // pixels

void checkLens(const CameraInfo& info) {
  const std::size_t count = info.D.size();
  const bool known = info.distortion_model == "plumb_bob" ? count == 0 || count == 5
                     : info.distortion_model == "rational_polynomial"
                         ? count == 8
                         : info.distortion_model.empty() && count == 0;
  if (!known)
    throw InputError(
        "its distortion must be plumb_bob with 5 coefficients or rational_polynomial with 8, it "
        "has " +
        std::to_string(count));
}

void checkPixels(const CameraInfo& info) {
  if (info.width > kLargestSide || info.height > kLargestSide)
    throw InputError("it is of an image of " + std::to_string(info.width) + " x " +
                     std::to_string(info.height) + " pixels");
  if (info.binning_x > 1 || info.binning_y > 1 || info.roi.width != 0 || info.roi.height != 0)
    throw InputError("it is of an image that is a part of the camera's or coarser (roi, binning)");
  if (info.K[1] != 0.0) throw InputError("its pixels are no rectangles (K has a skew)");
}

}  // namespace

vision::CameraCalibration calibrationOf(const CameraInfo& info) {
  checkLens(info);
  checkPixels(info);
  vision::CameraCalibration calibration{static_cast<int>(info.width),
                                        static_cast<int>(info.height),
                                        info.K[0],
                                        info.K[4],
                                        info.K[2],
                                        info.K[5],
                                        info.D};
  checkCalibration(calibration);
  const bool bends = std::any_of(info.D.begin(), info.D.end(), [](double d) { return d != 0.0; });
  if (!bends) calibration.distortion.clear();
  return calibration;
}

vision::EncodedImage encodedImageOf(const sensor_msgs::Image& image) {
  return {image.encoding,          image.width,       image.height,     image.step,
          image.is_bigendian != 0, image.data.data(), image.data.size()};
}

}  // namespace grid_path_planner::nodes
