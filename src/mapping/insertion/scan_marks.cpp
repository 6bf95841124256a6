#include "mapping/insertion/scan_marks.h"

#include <cstring>

namespace grid_path_planner::mapping {
namespace {

// Eight cells along z in one word, the lowest in its lowest byte.
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "rows of cells are read as words");

constexpr std::uint64_t kEveryByte = 0x0101010101010101;
// Two zero bits after each of up to 16 bits (one axis of a Morton code).
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000FF0000FF;
  bits = (bits | bits << 8) & 0x00F00F00F00F;
  bits = (bits | bits << 4) & 0x0C30C30C30C3;
  return (bits | bits << 2) & 0x249249249249;
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

// Adds the brick whose lowest cell is `cells`, if it has a mark.
void collectBrick(Mark* cells, std::int64_t stride_x, std::int64_t stride_y, BrickKey key,
                  std::vector<ScanMarks>& bricks) {
  std::uint64_t rows[64], any = 0;
  for (unsigned x = 0; x < 8; ++x)
    for (unsigned y = 0; y < 8; ++y) {
      std::uint64_t& row = rows[8 * x + y];
      std::memcpy(&row, cells + x * stride_x + y * stride_y, sizeof row);
      any |= row;
    }
  if (any == 0) return;
  bricks.push_back({key, mortonCode(key), {}, {}});
  ScanMarks& marks = bricks.back();
  for (unsigned x = 0; x < 8; ++x)
    for (unsigned y = 0; y < 8; ++y) {
      const std::uint64_t row = rows[8 * x + y];
      std::memset(cells + x * stride_x + y * stride_y, 0, sizeof row);
      addRow(marks.free, x, y, row & kEveryByte);
      if (any & 2 * kEveryByte) addRow(marks.hit, x, y, row >> 1 & kEveryByte);
    }
}

// Bricks of the window inside the cube of `edge` bricks at (x, y, z), by octants.
void collectCube(VoxelWindow& window, std::int32_t x, std::int32_t y, std::int32_t z,
                 std::int32_t edge, std::vector<ScanMarks>& bricks) {
  const std::int32_t lowest[] = {x, y, z};
  std::int64_t first_cell = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const std::int32_t offset = lowest[axis] - window.lowBrick()[axis];
    if (offset >= window.bricks()[axis] || offset + edge <= 0) return;
    first_cell += 8 * offset * window.strides()[axis];
  }
  if (edge == 1) {
    const BrickKey key{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                       static_cast<std::uint16_t>(z)};
    return collectBrick(window.cells() + first_cell, window.strides()[0], window.strides()[1], key,
                        bricks);
  }
  const std::int32_t half = edge / 2;
  for (unsigned i = 0; i < 8; ++i)
    collectCube(window, x + (i & 1 ? half : 0), y + (i & 2 ? half : 0), z + (i & 4 ? half : 0),
                half, bricks);
}

}  // namespace

std::uint64_t mortonCode(BrickKey key) {
  return spread(key.x) | spread(key.y) << 1 | spread(key.z) << 2;
}

void collectMarks(VoxelWindow& window, std::vector<ScanMarks>& bricks) {
  bricks.clear();
  collectCube(window, 0, 0, 0, VoxelWindow::kBricksAlongSpace, bricks);
  window.clearOutside();
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

OctantWords octantWords(const Brick::Words& words) {
  OctantWords octants{};
  for (unsigned y = 0; y < 8; ++y)
    for (unsigned x = 0; x < 8; ++x) {
      const std::uint64_t column = words[y] >> (8 * x) & 0xFF;
      if (column == 0) continue;
      const unsigned octant = x >> 2 | y >> 2 << 1;
      const unsigned shift = (x & 1) + 2 * (y & 1) + 8 * (x >> 1 & 1) + 16 * (y >> 1 & 1);
      for (unsigned z = 0; z < 8; ++z)
        octants[octant + 4 * (z >> 2)] |= (column >> z & 1)
                                          << (shift + 4 * (z & 1) + 32 * (z >> 1 & 1));
    }
  return octants;
}

}  // namespace grid_path_planner::mapping
