#include "grid_path_planner/simulation/depth_camera.h"

#include <algorithm>
#include <cmath>

#include "simulation/camera/pinhole.h"
#include "simulation/range_noise.h"
#include "simulation/ray_scene.h"

namespace grid_path_planner::simulation {
namespace {

constexpr std::size_t kPacket = RayScene::kPacket;
constexpr std::uint32_t kPacketsBetweenPolls = 256;

}  // namespace

DepthCamera::DepthCamera(const World& world, const DepthCameraOptions& options)
    : options_(options) {
  checkDepthCameraOptions(options);
  rays_ = raysOf(intrinsics(), options.width, options.height);
  scene_ = std::make_unique<const RayScene>(world.visible());
}

DepthCamera::~DepthCamera() = default;
DepthCamera::DepthCamera(DepthCamera&&) noexcept = default;
DepthCamera& DepthCamera::operator=(DepthCamera&&) noexcept = default;

CameraIntrinsics DepthCamera::intrinsics() const {
  return intrinsicsOf(options_.width, options_.height, options_.horizontal_fov);
}

Eigen::Isometry3d DepthCamera::baseFromOptical() const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(options_.x, options_.y, options_.z));
  pose.rotate(Eigen::AngleAxisd(options_.yaw, Eigen::Vector3d::UnitZ()));
  pose.rotate(Eigen::AngleAxisd(options_.pitch, Eigen::Vector3d::UnitY()));
  pose.rotate(Eigen::AngleAxisd(options_.roll, Eigen::Vector3d::UnitX()));
  return pose * opticalFrame();
}

void DepthCamera::render(const Eigen::Isometry3d& map_from_optical, std::uint64_t frame,
                         std::vector<float>& points, const BodiesAt& bodies,
                         const base::StopToken& stop) const {
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
  base::StopPoll poll(stop, kPacketsBetweenPolls);
  for (std::size_t first = 0; first < rays_.size(); first += kPacket) {
    poll();
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
