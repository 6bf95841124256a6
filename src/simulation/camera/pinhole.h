// The pinhole that all simulated cameras have: its rays, and where its optical frame is.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "grid_path_planner/simulation/depth_camera.h"

namespace grid_path_planner::simulation {

// Of an image with square pixels that is `horizontal_fov` (rad) wide from rim to rim.
CameraIntrinsics intrinsicsOf(int width, int height, double horizontal_fov);

// The ray, of length 1 in the optical frame, through a place in the image; pixel centres are at whole numbers.
Eigen::Vector3f rayThrough(const CameraIntrinsics& pinhole, double column, double row);

// Those of all pixels, row by row from the top left.
std::vector<Eigen::Vector3f> raysOf(const CameraIntrinsics& pinhole, int width, int height);

// The optical frame (z ahead, x right, y down) in the camera's own, which looks along x with z up.
Eigen::Isometry3d opticalFrame();

}  // namespace grid_path_planner::simulation
