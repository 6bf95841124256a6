#include "grid_path_planner/simulation/depth_camera.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "simulation/range_noise.h"

namespace grid_path_planner::simulation {
namespace {

constexpr std::size_t kPacket = 8;

template <class Handle, void (*release)(Handle)>
struct Release {
  void operator()(Handle handle) const { release(handle); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release<RTCDevice, rtcReleaseDevice>>;
using SceneHandle = std::unique_ptr<RTCSceneTy, Release<RTCScene, rtcReleaseScene>>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release<RTCGeometry, rtcReleaseGeometry>>;

void throwOnError(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error("Embree failed with error " + std::to_string(error));
}

// `buffer` of a geometry, filled with a copy of `items`.
template <class Item>
void copyTo(RTCGeometry geometry, RTCBufferType buffer, RTCFormat format,
            const std::vector<Item>& items) {
  void* memory = rtcSetNewGeometryBuffer(geometry, buffer, 0, format, sizeof(Item), items.size());
  if (memory != nullptr) std::copy(items.begin(), items.end(), static_cast<Item*>(memory));
}

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

// Embree's view of the visible surfaces.
class DepthCamera::Scene {
 public:
  explicit Scene(const std::vector<TriangleMesh>& meshes)
      : device_(rtcNewDevice("threads=1,set_affinity=0")) {
    if (!device_) throwOnError(nullptr);
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);  // no ray slips between two triangles
    for (const TriangleMesh& mesh : meshes) attach(mesh);
    rtcCommitScene(scene_.get());
    throwOnError(device_.get());
  }

  // Ranges of `count` <= kPacket rays of length 1 from `origin`; infinite where they meet nothing
  // within `farthest`.
  void ranges(const Eigen::Vector3f& origin, const Eigen::Matrix3f& turn,
              const Eigen::Vector3f* rays, std::size_t count, float farthest, float* out) const {
    RTCRayHit8 packet = {};
    alignas(32) int valid[kPacket] = {};
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f direction = turn * rays[i];
      valid[i] = -1;
      packet.ray.org_x[i] = origin.x();
      packet.ray.org_y[i] = origin.y();
      packet.ray.org_z[i] = origin.z();
      packet.ray.dir_x[i] = direction.x();
      packet.ray.dir_y[i] = direction.y();
      packet.ray.dir_z[i] = direction.z();
      packet.ray.tfar[i] = farthest;
      packet.ray.mask[i] = ~0u;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect8(valid, scene_.get(), &context, &packet);
    for (std::size_t i = 0; i < count; ++i)
      out[i] = packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                   ? std::numeric_limits<float>::infinity()
                   : packet.ray.tfar[i];
  }

 private:
  void attach(const TriangleMesh& mesh) {
    const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    copyTo(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices);
    copyTo(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
    throwOnError(device_.get());
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene_.get(), geometry.get());
  }

  Device device_;
  SceneHandle scene_;
};

DepthCamera::DepthCamera(const World& world, const DepthCameraOptions& options)
    : options_(options) {
  checkDepthCameraOptions(options);
  rays_ = raysOf(options);
  scene_ = std::make_unique<Scene>(world.visible());
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
