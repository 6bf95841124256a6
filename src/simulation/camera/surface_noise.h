// Blotches on surfaces: value noise in space, so that a surface has the same from everywhere.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace grid_path_planner::simulation {

class SurfaceNoise {
 public:
  SurfaceNoise(int seed, double size)
      : seed_(static_cast<std::uint32_t>(seed)), scale_(static_cast<float>(1.0 / size)) {}

  // From -1 to 1 with mean 0; smooth over distances much shorter than the size of a blotch.
  float at(const Eigen::Vector3f& point) const {
    std::uint32_t hash = seed_;
    float low[3], high[3];  // the weights of a cell's lower and upper side
    constexpr std::uint32_t kPrimes[3] = {kX, kY, kZ};
    for (int axis = 0; axis < 3; ++axis) {
      const float scaled = point[axis] * scale_;
      const int cell = floorOf(scaled);
      high[axis] = scaled - static_cast<float>(cell);
      low[axis] = 1.0f - high[axis];
      hash += static_cast<std::uint32_t>(cell) * kPrimes[axis];
    }
    const float xy[4] = {low[0] * low[1], high[0] * low[1], low[0] * high[1], high[0] * high[1]};
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) sum += xy[i] * low[2] * drawn(hash + kCorners[i]);
    for (int i = 0; i < 4; ++i) sum += xy[i] * high[2] * drawn(hash + kZ + kCorners[i]);
    return sum;
  }

 private:
  static constexpr std::uint32_t kX = 0x8da6b343u, kY = 0xd8163841u, kZ = 0xcb1ab31fu;
  static constexpr std::uint32_t kCorners[4] = {0, kX, kY, kX + kY};

  static int floorOf(float value) {
    const int truncated = static_cast<int>(value);
    return truncated - (value < static_cast<float>(truncated));
  }

  // Even in [-1, 1), of a lattice point's sum of large primes (Chris Wellons' lowbias32).
  static float drawn(std::uint32_t h) {
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return static_cast<float>(static_cast<std::int32_t>(h >> 8)) * 0x1p-23f - 1.0f;
  }

  std::uint32_t seed_;
  float scale_;
};

}  // namespace grid_path_planner::simulation
