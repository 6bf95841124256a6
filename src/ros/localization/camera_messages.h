// Messages of a camera as the room vision takes them.
//
//   const vision::CameraCalibration calibration = calibrationOf(camera_info);     // throws InputError
//   const std::vector<std::uint8_t> grey = vision::greyPixels(encodedImageOf(image));
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "vision/camera_calibration.h"
#include "vision/grey_conversion.h"

namespace grid_path_planner::nodes {

// Throws InputError as checkCalibration does, and for a lens that is neither plumb_bob nor rational_polynomial, for
// images that are a part of the camera's or coarser (roi, binning), and for pixels that are not upright.
vision::CameraCalibration calibrationOf(const sensor_msgs::CameraInfo& info);

// Only as long as the message.
vision::EncodedImage encodedImageOf(const sensor_msgs::Image& image);

}  // namespace grid_path_planner::nodes
