// The calibration of a simulated camera as a message without a header.
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "grid_path_planner/simulation/depth_camera.h"

namespace grid_path_planner::nodes {

// Of a pinhole whose images have width x height pixels, without distortion.
sensor_msgs::CameraInfo cameraInfoOf(const simulation::CameraIntrinsics& pinhole, int width,
                                     int height);

}  // namespace grid_path_planner::nodes
