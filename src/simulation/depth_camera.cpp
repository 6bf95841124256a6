#include "grid_path_planner/simulation/depth_camera.h"

#include <algorithm>
#include <cmath>

#include "simulation/range_noise.h"
#include "simulation/ray_scene.h"

namespace grid_path_planner::simulation {
namespace {

constexpr std::size_t kPacket = RayScene::kPacket;

CameraIntrinsics intrinsicsOf(const DepthCameraOptions& options) {
  const double focal = 0.5 * options.width / std::tan(0.5 * options.horizontal_fov);
  return {focal, focal, 0.5 * (options.width - 1), 0.5 * (options.height - 1)};
}

std::vector<Eigen::Vector3f> raysOf(const DepthCameraOptions& options) {
  const CameraIntrinsics pinhole = intrinsicsOf(options);
  std::vector<Eigen::Vector3f> rays;
  rays.reserve(static_cast<std::size_t>(options.width) * options.height);
  for (int row = 0; row < options.height; ++row)
    for (int column = 0; column < options.width; ++column)
      rays.push_back(
          Eigen::Vector3d((column - pinhole.cx) / pinhole.fx, (row - pinhole.cy) / pinhole.fy, 1.0)
              .normalized()
              .cast<float>());
  return rays;
}

}  // namespace

DepthCamera::DepthCamera(const World& world, const DepthCameraOptions& options)
    : options_(options) {
  checkDepthCameraOptions(options);
  rays_ = raysOf(options);
  scene_ = std::make_unique<const RayScene>(world.visible());
}

DepthCamera::~DepthCamera() = default;
DepthCamera::DepthCamera(DepthCamera&&) noexcept = default;
DepthCamera& DepthCamera::operator=(DepthCamera&&) noexcept = default;

CameraIntrinsics DepthCamera::intrinsics() const {
  return intrinsicsOf(options_);
}

Eigen::Isometry3d DepthCamera::baseFromOptical() const {
  Eigen::Matrix3d ahead_is_z;   // columns: the optical axes in the frame that looks along x
  ahead_is_z << 0.0, 0.0, 1.0,  //
      -1.0, 0.0, 0.0,           //
      0.0, -1.0, 0.0;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(options_.x, options_.y, options_.z));
  pose.rotate(Eigen::AngleAxisd(options_.yaw, Eigen::Vector3d::UnitZ()));
  pose.rotate(Eigen::AngleAxisd(options_.pitch, Eigen::Vector3d::UnitY()));
  pose.rotate(Eigen::AngleAxisd(options_.roll, Eigen::Vector3d::UnitX()));
  pose.rotate(ahead_is_z);
  return pose;
}

void DepthCamera::render(const Eigen::Isometry3d& map_from_optical, std::uint64_t frame,
                         std::vector<float>& points, const BodiesAt& bodies) const {
  const Eigen::Matrix3f turn = map_from_optical.linear().cast<float>();
  const Eigen::Vector3f origin = map_from_optical.translation().cast<float>();
  const RangeNoise noise(options_.seed, frame);
  const auto nearest = static_cast<float>(options_.range_min);
  const auto farthest = static_cast<float>(options_.range_max);
  const auto base = static_cast<float>(options_.noise_base);
  const auto growth = static_cast<float>(options_.noise_per_m2);
  const auto measured = [&](float range, std::size_t pixel) {
    if (!(range >= nearest && range <= farthest)) return NAN;
    if (options_.dropout > 0.0 && noise.share(pixel) < options_.dropout) return NAN;
    const float noisy = range + (base + growth * range * range) * noise.deviation(pixel);
    return noisy >= nearest && noisy <= farthest ? noisy : NAN;
  };
  points.resize(3 * rays_.size());
  for (std::size_t first = 0; first < rays_.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays_.size() - first);
    float ranges[kPacket];
    scene_->ranges(origin, turn, &rays_[first], count, farthest, ranges);
    for (std::size_t i = 0; i < count && !bodies.empty(); ++i)
      ranges[i] = std::min(ranges[i], static_cast<float>(bodies.range(
                                          origin.cast<double>(),
                                          (turn * rays_[first + i]).cast<double>().normalized())));
    for (std::size_t i = first; i < first + count; ++i) {
      Eigen::Map<Eigen::Vector3f> point(&points[3 * i]);
      point = measured(ranges[i - first], i) * rays_[i];
    }
  }
}

}  // namespace grid_path_planner::simulation
