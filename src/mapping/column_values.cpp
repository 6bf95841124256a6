#include "mapping/column_values.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace grid_path_planner::mapping {
namespace {

constexpr int kLargestKey = 65535;
constexpr std::uint64_t kOnes = 0x0101010101010101;  // a 1 in every byte

// For each cell a byte with a bit for each voxel, laid out as in a brick: all bricks united.
using Seen = Brick;

int keyOf(double voxels) {
  return static_cast<int>(std::clamp(voxels + kKeyOfZero, -1.0, kLargestKey + 1.0));
}

// The bits of a brick's byte that lie in the band.
std::uint8_t bitsInBand(int brick, const VoxelBand& band) {
  const int first = std::max(band.lowest - 8 * brick, 0);
  const int last = std::min(band.highest - 8 * brick, 7);
  if (first > last) return 0;
  return static_cast<std::uint8_t>((0xff << first) & (0xff >> (7 - last)));
}

// Eight cells at a time.
void addMasked(const Brick& brick, std::uint8_t mask, Seen& seen) {
  const std::uint64_t mask_of_eight = mask * kOnes;
  for (std::size_t y = 0; y < 8; ++y) {
    seen.occupied[y] |= brick.occupied[y] & mask_of_eight;
    seen.known[y] |= brick.known[y] & mask_of_eight;
  }
}

// A mask for each of the eight cells of row y.
std::uint64_t masksOfRow(const std::array<VoxelBand, 64>& bands, std::size_t y, int brick) {
  std::uint64_t masks = 0;
  for (std::size_t x = 0; x < 8; ++x)
    masks |= std::uint64_t{bitsInBand(brick, bands[8 * y + x])} << (8 * x);
  return masks;
}

// A 1 for every byte that is not 0.
std::uint64_t nonZeroBytes(std::uint64_t bytes) {
  const std::uint64_t low_bits = 0x7f * kOnes;
  return ((bytes | ((bytes & low_bits) + low_bits)) >> 7) & kOnes;
}

// Eight cells at a time: 100 where a voxel is occupied, else -1 (0xff) where none is known.
ColumnValues valuesOf(const Seen& seen) {
  ColumnValues values;
  for (std::size_t y = 0; y < 8; ++y) {
    const std::uint64_t row =
        nonZeroBytes(seen.occupied[y]) * 100 + (kOnes ^ nonZeroBytes(seen.known[y])) * 0xff;
    for (std::size_t x = 0; x < 8; ++x)
      values[8 * y + x] = static_cast<std::int8_t>(row >> (8 * x));
  }
  return values;
}

}  // namespace

VoxelBand voxelBand(double min_z, double max_z, double resolution) {
  return {keyOf(std::floor(min_z / resolution + kOnTheLattice)),
          keyOf(std::ceil(max_z / resolution - kOnTheLattice) - 1.0)};
}

ColumnValues columnValues(const OccupancyBricks& bricks, BrickColumn column,
                          const VoxelBand& band) {
  Seen seen;
  bricks.forEachBrick(column, [&](int z, const Brick& brick) {
    const std::uint8_t mask = bitsInBand(z, band);
    if (mask != 0) addMasked(brick, mask, seen);
  });
  return valuesOf(seen);
}

ColumnValues columnValues(const OccupancyBricks& bricks, BrickColumn column,
                          const std::array<VoxelBand, 64>& bands) {
  Seen seen;
  bricks.forEachBrick(column, [&](int z, const Brick& brick) {
    for (std::size_t y = 0; y < 8; ++y) {
      const std::uint64_t masks = masksOfRow(bands, y, z);
      seen.occupied[y] |= brick.occupied[y] & masks;
      seen.known[y] |= brick.known[y] & masks;
    }
  });
  return valuesOf(seen);
}

}  // namespace grid_path_planner::mapping
