// The window of voxels about the vehicle: a ring in each axis, so that nothing moves when it travels.
//
// A voxel's index counts voxels from the map's origin; its slot is the index modulo the size of the ring.
// The window is smaller than the ring, so that a gap of empty slots lies between its far sides.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

namespace grid_path_planner::avoidance {

constexpr double kVoxel = 0.2;  // m

constexpr int kRingX = 128, kRingY = 128, kRingZ = 64;
constexpr int kReach = 60;   // voxels from the centre to the sides of the window: 12 m
constexpr int kReachZ = 30;  // 6 m
constexpr int kSlots = kRingX * kRingY * kRingZ;

struct Voxel {
  int x, y, z;

  friend bool operator==(const Voxel& a, const Voxel& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

inline int voxelIndex(double coordinate) {
  const double voxels = coordinate * (1.0 / kVoxel);
  const int whole = static_cast<int>(voxels);  // std::floor is a call without SSE 4.1
  return whole - (voxels < whole ? 1 : 0);
}
inline Voxel voxelAt(const Eigen::Vector3d& point) {
  return {voxelIndex(point.x()), voxelIndex(point.y()), voxelIndex(point.z())};
}
inline Eigen::Vector3d centreOf(const Voxel& voxel) {
  return kVoxel * Eigen::Vector3d(voxel.x + 0.5, voxel.y + 0.5, voxel.z + 0.5);
}
inline int slotOf(int x, int y, int z) {
  return ((z & (kRingZ - 1)) << 14) | ((y & (kRingY - 1)) << 7) | (x & (kRingX - 1));
}
inline int slotOf(const Voxel& voxel) {
  return slotOf(voxel.x, voxel.y, voxel.z);
}

// Which voxels are inside.
struct Window {
  Voxel centre = {0, 0, 0};

  bool contains(const Voxel& v) const {
    return std::abs(v.x - centre.x) <= kReach && std::abs(v.y - centre.y) <= kReach &&
           std::abs(v.z - centre.z) <= kReachZ;
  }
  // The voxel inside that has this slot.
  Voxel voxelOf(int slot) const {
    const auto unwrap = [](int wrapped, int middle, int size) {
      const int low = middle - size / 2;
      return low + ((wrapped - low) & (size - 1));
    };
    return {unwrap(slot & 127, centre.x, kRingX), unwrap((slot >> 7) & 127, centre.y, kRingY),
            unwrap(slot >> 14, centre.z, kRingZ)};
  }
};

// A bit for each slot, 64 along x in a word.
class SlotBits {
 public:
  SlotBits() : words_(kSlots / 64, 0) {}

  bool get(int slot) const { return (words_[slot >> 6] >> (slot & 63)) & 1u; }
  void set(int slot) { words_[slot >> 6] |= std::uint64_t{1} << (slot & 63); }
  void clear(int slot) { words_[slot >> 6] &= ~(std::uint64_t{1} << (slot & 63)); }
  void fill(bool value) { words_.assign(words_.size(), value ? ~std::uint64_t{0} : 0); }

  std::vector<std::uint64_t>& words() { return words_; }
  const std::vector<std::uint64_t>& words() const { return words_; }

 private:
  std::vector<std::uint64_t> words_;
};

}  // namespace grid_path_planner::avoidance
