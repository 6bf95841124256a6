// What a scan saw, voxel by voxel: a byte for each in tiles of 16x16x16, made where rays pass.
//
// For scans whose rays leave most of the box around them alone, a few long ones say: memory grows
// with what the rays touch. VoxelWindow is faster where it fits.
#pragma once

#include <octomap/octomap_types.h>

#include <octomap/OcTreeKey.h>

#include <array>
#include <cstdint>
#include <deque>
#include <unordered_map>

#include "voxel_mark.h"

namespace grid_path_planner {

struct VoxelTile {
  static constexpr unsigned kEdgeBits = 4, kEdge = 1u << kEdgeBits;

  static constexpr std::size_t place(std::size_t x, std::size_t y, std::size_t z) {
    return (x % kEdge << kEdgeBits | y % kEdge) << kEdgeBits | z % kEdge;
  }

  std::array<std::uint16_t, 3> position;  // keys >> kEdgeBits
  std::array<Mark, kEdge * kEdge * kEdge> cells{};
};

class VoxelTiles {
 public:
  // The tile of a voxel, made if need be; it stays where it is until clear().
  VoxelTile& tileOf(const octomap::OcTreeKey& key);

  // All of them, to be read and forgotten.
  std::deque<VoxelTile>& tiles() { return tiles_; }
  void clear();

 private:
  std::deque<VoxelTile> tiles_;
  std::unordered_map<std::uint64_t, VoxelTile*> by_position_;
};

}  // namespace grid_path_planner
