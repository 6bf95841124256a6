// A depth camera in a simulated world: one ray for each pixel.
//
//   DepthCamera camera(world, options);
//   std::vector<float> points;
//   camera.render(map_from_base * camera.baseFromOptical(), frame_number, points);
//   const float* xyz = &points[3 * (row * options.width + column)];
//
// A pixel's point lies on its ray through the pinhole, in the optical frame (REP 103: z ahead,
// x right, y down), at the range of the first surface plus noise. Noise has mean 0 and the standard
// deviation noise_base + noise_per_m2 * range^2; it is nearly normal, and never more than 3.47
// standard deviations. Three NaNs stand where nothing was measured: no surface between range_min
// and range_max, a surface nearer than range_min in front, noise that carries a range out of these
// limits, or a dropout.
//
// Guaranteed: the same world, options, pose and frame number give the same points, bit for bit,
// whatever was rendered before; other frame numbers give noise that is independent of it. Not
// modelled: light, water, motion during the exposure.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/simulation/depth_camera_options.h"
#include "grid_path_planner/simulation/moving_bodies.h"
#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::simulation {

class RayScene;

// Of a pinhole: the point x, y, z is seen at column cx + fx x / z, row cy + fy y / z; pixel (0, 0)
// has its centre at column 0, row 0, as in sensor_msgs/CameraInfo.
struct CameraIntrinsics {
  double fx, fy, cx, cy;  // pixels
};

class DepthCamera {
 public:
  // Prepares the visible surfaces for rays: some 0.1 s for 100,000 triangles. Throws InputError for
  // options that checkDepthCameraOptions refuses. The world is not needed afterwards.
  explicit DepthCamera(const World& world, const DepthCameraOptions& options = {});
  ~DepthCamera();
  DepthCamera(DepthCamera&&) noexcept;
  DepthCamera& operator=(DepthCamera&&) noexcept;

  const DepthCameraOptions& options() const { return options_; }
  CameraIntrinsics intrinsics() const;
  // The optical frame in base_link.
  Eigen::Isometry3d baseFromOptical() const;

  // Fills `points` with x, y, z (m) of width x height pixels, row by row from the top left. Throws Stopped.
  void render(const Eigen::Isometry3d& map_from_optical, std::uint64_t frame,
              std::vector<float>& points, const BodiesAt& bodies = {},
              const base::StopToken& stop = {}) const;

 private:
  DepthCameraOptions options_;
  std::vector<Eigen::Vector3f> rays_;  // of length 1, optical frame, row by row
  std::unique_ptr<const RayScene> scene_;
};

}  // namespace grid_path_planner::simulation
