// The visible surfaces of a world, prepared for rays (Embree): what cameras and acoustic beams see.
//
//   const RayScene scene(world.visible());
//   scene.ranges(origin, map_from_sensor, rays, 4, 90.0f, ranges);
//
// Guaranteed: the same meshes and rays give the same ranges, bit for bit; no ray slips between two
// triangles. Several threads may cast rays into one scene.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/simulation/triangle_mesh.h"

namespace grid_path_planner::simulation {

// What a ray meets first.
struct RayHit {
  float range;             // m; infinite where it meets nothing
  std::uint32_t surface;   // the number of the mesh, or kNothing
  Eigen::Vector3f normal;  // of length 1, on either side of the surface
};

class RayScene {
 public:
  static constexpr std::uint32_t kNothing = ~0u;
  static constexpr std::size_t kPacket = 8;  // rays that are cast together

  // Some 0.1 s for 100,000 triangles. Throws std::runtime_error where Embree fails, as without
  // memory.
  explicit RayScene(const std::vector<TriangleMesh>& meshes);
  ~RayScene();

  // Ranges (m) of `count` <= kPacket rays of length 1 from `origin`, each turned by `turn`; infinite
  // where a ray meets nothing within `farthest`.
  void ranges(const Eigen::Vector3f& origin, const Eigen::Matrix3f& turn,
              const Eigen::Vector3f* rays, std::size_t count, float farthest, float* out) const;

  // The same with what they meet.
  void hits(const Eigen::Vector3f& origin, const Eigen::Matrix3f& turn, const Eigen::Vector3f* rays,
            std::size_t count, float farthest, RayHit* out) const;

 private:
  struct Embree;

  std::unique_ptr<const Embree> embree_;
};

}  // namespace grid_path_planner::simulation
