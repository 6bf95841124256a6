// Blotches on surfaces: value noise in space, so that a surface has the same from everywhere.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace grid_path_planner::simulation {

class SurfaceNoise {
 public:
  SurfaceNoise(int seed, double size)
      : seed_(static_cast<std::uint32_t>(seed)), scale_(static_cast<float>(1.0 / size)) {}

  // From -1 to 1 with mean 0; smooth over distances much shorter than the size of a blotch.
  float at(const Eigen::Vector3f& point) const {
    const Eigen::Array3f scaled = point.array() * scale_;
    const Eigen::Array3f corner = scaled.floor();
    const Eigen::Array3f share = scaled - corner;
    const Eigen::Array3i cell = corner.cast<int>();
    float sum = 0.0f;
    for (int i = 0; i < 8; ++i) {
      const int x = i & 1, y = i >> 1 & 1, z = i >> 2;
      sum += (x ? share.x() : 1.0f - share.x()) * (y ? share.y() : 1.0f - share.y()) *
             (z ? share.z() : 1.0f - share.z()) * drawn(cell.x() + x, cell.y() + y, cell.z() + z);
    }
    return sum;
  }

 private:
  // Even in [-1, 1), of a lattice point (Chris Wellons' lowbias32 of three large primes' sum).
  float drawn(int x, int y, int z) const {
    std::uint32_t h = seed_ + static_cast<std::uint32_t>(x) * 0x8da6b343u +
                      static_cast<std::uint32_t>(y) * 0xd8163841u +
                      static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return static_cast<float>(h >> 8) * 0x1p-23f - 1.0f;
  }

  std::uint32_t seed_;
  float scale_;
};

}  // namespace grid_path_planner::simulation
