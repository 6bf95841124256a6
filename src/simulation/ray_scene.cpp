#include "simulation/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace grid_path_planner::simulation {
namespace {

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

void attach(RTCDevice device, RTCScene scene, const TriangleMesh& mesh) {
  const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  copyTo(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices);
  copyTo(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  throwOnError(device);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene, geometry.get());
}

}  // namespace

struct RayScene::Embree {
  explicit Embree(const std::vector<TriangleMesh>& meshes)
      : device(rtcNewDevice("threads=1,set_affinity=0")) {
    if (!device) throwOnError(nullptr);
    scene.reset(rtcNewScene(device.get()));
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);  // no slower to build here
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);  // no ray slips between two triangles
    for (const TriangleMesh& mesh : meshes) attach(device.get(), scene.get(), mesh);
    rtcCommitScene(scene.get());
    throwOnError(device.get());
  }

  RTCRayHit8 cast(const Eigen::Vector3f& origin, const Eigen::Matrix3f& turn,
                  const Eigen::Vector3f* rays, std::size_t count, float farthest) const {
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
    rtcIntersect8(valid, scene.get(), &context, &packet);
    return packet;
  }

  Device device;
  SceneHandle scene;
};

RayScene::RayScene(const std::vector<TriangleMesh>& meshes)
    : embree_(std::make_unique<const Embree>(meshes)) {}

RayScene::~RayScene() = default;

void RayScene::ranges(const Eigen::Vector3f& origin, const Eigen::Matrix3f& turn,
                      const Eigen::Vector3f* rays, std::size_t count, float farthest,
                      float* out) const {
  const RTCRayHit8 packet = embree_->cast(origin, turn, rays, count, farthest);
  for (std::size_t i = 0; i < count; ++i)
    out[i] = packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                 ? std::numeric_limits<float>::infinity()
                 : packet.ray.tfar[i];
}

void RayScene::hits(const Eigen::Vector3f& origin, const Eigen::Matrix3f& turn,
                    const Eigen::Vector3f* rays, std::size_t count, float farthest,
                    RayHit* out) const {
  static_assert(kNothing == RTC_INVALID_GEOMETRY_ID);
  const RTCRayHit8 packet = embree_->cast(origin, turn, rays, count, farthest);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f normal(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]);
    const bool met = packet.hit.geomID[i] != kNothing;
    out[i] = {met ? packet.ray.tfar[i] : std::numeric_limits<float>::infinity(),
              packet.hit.geomID[i], met ? normal.normalized() : normal};
  }
}

}  // namespace grid_path_planner::simulation
