#include "brick_marks.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace grid_path_planner {
namespace {

// Eight cells along z in one word, the lowest in its lowest byte.
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "rows of cells are read as words");

constexpr std::uint64_t kEveryByte = 0x0101010101010101;
constexpr unsigned kBricksAlongTile = VoxelTile::kEdge / 8;

// Three coordinates of up to 16 bits as one number, bit by bit: x, y, z from below.
std::uint64_t interleaved(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const auto spread = [](std::uint64_t bits) {
    bits = (bits | bits << 16) & 0x0000FF0000FF;
    bits = (bits | bits << 8) & 0x00F00F00F00F;
    bits = (bits | bits << 4) & 0x0C30C30C30C3;
    return (bits | bits << 2) & 0x249249249249;
  };
  return spread(x) | spread(y) << 1 | spread(z) << 2;
}

// Four voxels along z, given as the lowest bits of four bytes, as bits of an octant's word.
std::uint64_t alongOctant(std::uint32_t bytes) {
  const std::uint32_t pairs = bytes | bytes >> 4;
  return (pairs & 0x11) | static_cast<std::uint64_t>(pairs & 0x110000) << 16;
}

void addRow(OctantWords& octants, unsigned x, unsigned y, std::uint64_t bytes) {
  const unsigned octant = x >> 2 | y >> 2 << 1;
  const unsigned shift = (x & 1) + 2 * (y & 1) + 8 * (x >> 1 & 1) + 16 * (y >> 1 & 1);
  octants[octant] |= alongOctant(static_cast<std::uint32_t>(bytes)) << shift;
  octants[octant + 4] |= alongOctant(static_cast<std::uint32_t>(bytes >> 32)) << shift;
}

// Whether the brick of the tile at these multiples of 8 has a mark.
bool takeMarks(VoxelTile& tile, unsigned x0, unsigned y0, unsigned z0, BrickMarks& marks) {
  marks.free = {};
  marks.hit = {};
  std::uint64_t any = 0;
  for (unsigned x = 0; x < 8; ++x)
    for (unsigned y = 0; y < 8; ++y) {
      Mark* const row = &tile.cells[VoxelTile::place(x0 + x, y0 + y, z0)];
      std::uint64_t cells;
      std::memcpy(&cells, row, sizeof cells);
      if (cells == 0) continue;
      std::memset(row, 0, sizeof cells);
      any |= cells;
      addRow(marks.free, x, y, cells & kEveryByte);
      if (cells & 2 * kEveryByte) addRow(marks.hit, x, y, cells >> 1 & kEveryByte);
    }
  return any != 0;
}

void collectTile(VoxelTile& tile, std::vector<BrickMarks>& bricks) {
  constexpr unsigned kCount = kBricksAlongTile * kBricksAlongTile * kBricksAlongTile;
  static_assert(kBricksAlongTile == 2, "the children of a tile are bricks");
  for (unsigned child = 0; child < kCount; ++child) {
    const unsigned x = child & 1, y = child >> 1 & 1, z = child >> 2;
    bricks.emplace_back();
    BrickMarks& marks = bricks.back();
    marks.key = {static_cast<std::uint16_t>(tile.position[0] * kBricksAlongTile + x),
                 static_cast<std::uint16_t>(tile.position[1] * kBricksAlongTile + y),
                 static_cast<std::uint16_t>(tile.position[2] * kBricksAlongTile + z)};
    marks.order = interleaved(marks.key.x, marks.key.y, marks.key.z);
    if (!takeMarks(tile, 8 * x, 8 * y, 8 * z, marks)) bricks.pop_back();
  }
}

}  // namespace

void collectMarks(const VoxelTiles& tiles, std::vector<BrickMarks>& bricks) {
  std::vector<std::pair<std::uint64_t, VoxelTile*>> order;
  order.reserve(tiles.tiles().size());
  for (VoxelTile* tile : tiles.tiles())
    order.emplace_back(interleaved(tile->position[0], tile->position[1], tile->position[2]), tile);
  std::sort(order.begin(), order.end());
  bricks.clear();
  for (const auto& entry : order) collectTile(*entry.second, bricks);
}

Brick::Words brickWords(const OctantWords& octants) {
  Brick::Words words{};
  for (unsigned octant = 0; octant < 8; ++octant)
    for (unsigned child = 0; child < 8; ++child) {
      const std::uint64_t voxels = octants[octant] >> (8 * child) & 0xFF;
      if (voxels == 0) continue;
      const unsigned x = 4 * (octant & 1) + 2 * (child & 1);
      const unsigned y = 4 * (octant >> 1 & 1) + 2 * (child >> 1 & 1);
      const unsigned z = 4 * (octant >> 2) + 2 * (child >> 2);
      for (unsigned row = 0; row < 2; ++row) {
        const std::uint64_t pairs = voxels >> (2 * row);  // bits 0, 1: x at z; 4, 5: x at z + 1
        const std::uint64_t bits =
            (pairs & 1) | (pairs >> 4 & 1) << 1 | (pairs >> 1 & 1) << 8 | (pairs >> 5 & 1) << 9;
        words[y + row] |= bits << (8 * x + z);
      }
    }
  return words;
}

}  // namespace grid_path_planner
