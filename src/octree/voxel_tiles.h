// What one scan saw, voxel by voxel: a byte for each in tiles of 16x16x16, made where rays pass.
//
// A byte and not a bit, since marking one is then a single store that waits for nothing; tiles and
// not one box, so that a scan needs memory where its rays went and not where they could have gone.
#pragma once

#include <octomap/octomap_types.h>

#include <octomap/OcTreeKey.h>

#include <array>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

namespace grid_path_planner {

enum class Mark : std::uint8_t { NONE = 0, FREE = 1, HIT = 2 };

struct VoxelTile {
  static constexpr unsigned kEdgeBits = 4, kEdge = 1u << kEdgeBits;

  // The voxel's place in `cells`: x counts most, z least.
  static constexpr std::uint32_t place(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return (x % kEdge << kEdgeBits | y % kEdge) << kEdgeBits | z % kEdge;
  }

  std::array<Mark, kEdge * kEdge * kEdge> cells{};
  std::array<VoxelTile*, 6> neighbors{};    // by 2 * axis + (1 if forward); null: not looked up yet
  std::array<std::uint16_t, 3> position{};  // keys >> kEdgeBits
};

class VoxelTiles {
 public:
  // The tile of a voxel, made if need be; it stays where it is until clear().
  VoxelTile& tileOf(const octomap::OcTreeKey& key);

  // The next tile along an axis (0 to 2); behind the border of space that on its other side.
  VoxelTile& neighbor(VoxelTile& tile, unsigned axis, bool forward) {
    VoxelTile*& next = tile.neighbors[2 * axis + forward];
    if (!next) next = &lookUpNeighbor(tile, axis, forward);
    return *next;
  }

  // Those made since the last clear().
  const std::vector<VoxelTile*>& tiles() const { return used_; }

  // Forgets all tiles. Requires that their cells are NONE again: who reads them last clears them.
  void clear();

  std::size_t memoryUsage() const { return pool_.size() * sizeof(VoxelTile); }

 private:
  // So many stay allocated for the next scan: 36 MB.
  static constexpr std::size_t kKept = 8192;
  static constexpr std::uint16_t kLastPosition = 0xFFFF >> VoxelTile::kEdgeBits;

  VoxelTile& tileAt(const std::array<std::uint16_t, 3>& position);
  VoxelTile& lookUpNeighbor(const VoxelTile& tile, unsigned axis, bool forward);

  std::deque<VoxelTile> pool_;
  std::vector<VoxelTile*> used_;
  std::unordered_map<std::uint64_t, VoxelTile*> by_position_;
};

}  // namespace grid_path_planner
