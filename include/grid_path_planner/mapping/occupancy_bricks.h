// Which voxels of an octree are known and which of them are occupied, as bits in bricks of 8x8x8.
//
// The tree is for queries of a point; a brick gives the voxels of 64 columns at once, and the set of
// changed brick columns is what is to be projected again after a scan.
//
//   bricks.setBrick({x, y, z}, content);                       // by whoever changes the tree
//   for (BrickColumn column : bricks.drainChangedColumns())
//     bricks.forEachBrick(column, [&](std::uint16_t z, const Brick& brick) { use(z, brick); });
//
// Coordinates are keys of OctoMap: voxel (x, y, z) is in brick (x >> 3, y >> 3, z >> 3), and the
// lower corner of voxel x lies at (x - 32768) * resolution metres.
//
// Guaranteed: an occupied voxel is known; a brick without a known voxel does not exist; a column is
// drained if a bit of it has changed since the last draining, and once at most. Uniform bricks
// (wholly free or wholly occupied) take four bytes.
// Not guaranteed: that a drained column differs from before, as changes may undo each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include <octomap/OcTreeKey.h>  // after <cstdint>, which it needs

namespace grid_path_planner::mapping {

// Bit 8 * (x & 7) + (z & 7) of word y & 7: on a little-endian machine byte 8 * (y & 7) + (x & 7)
// holds the eight voxels of one column, the lowest in its lowest bit.
struct Brick {
  using Words = std::array<std::uint64_t, 8>;
  Words known{};
  Words occupied{};

  // The eight voxels of column (x & 7, y & 7), the lowest in bit 0.
  static std::uint8_t column(const Words& words, unsigned x, unsigned y) {
    return static_cast<std::uint8_t>(words[y & 7] >> (8 * (x & 7)));
  }
};

// Keys >> 3.
struct BrickColumn {
  std::uint16_t x, y;
  friend bool operator==(const BrickColumn& a, const BrickColumn& b) {
    return a.x == b.x && a.y == b.y;
  }
};

struct BrickKey {
  std::uint16_t x, y, z;
  static BrickKey of(const octomap::OcTreeKey& voxel) {
    return {static_cast<std::uint16_t>(voxel[0] >> 3), static_cast<std::uint16_t>(voxel[1] >> 3),
            static_cast<std::uint16_t>(voxel[2] >> 3)};
  }
  BrickColumn column() const { return {x, y}; }
};

enum class Voxel { UNKNOWN, FREE, OCCUPIED };

class OccupancyBricks {
 public:
  // `resolution` is the edge of a voxel in metres.
  explicit OccupancyBricks(double resolution) : resolution_(resolution) {}

  double resolution() const { return resolution_; }

  Voxel voxel(const octomap::OcTreeKey& key) const;
  // Valid until the next change.
  const Brick& brick(BrickKey key) const { return brick(handleOf(key)); }
  void setVoxel(const octomap::OcTreeKey& key, Voxel state);
  // Every voxel of the brick.
  void setBrick(BrickKey key, const Brick& content);
  void fillBrick(BrickKey key, Voxel state);
  // Forgets everything: all columns count as changed. `resolution` is that of what comes next.
  void clear(double resolution);

  // Every column with a known voxel, in no particular order.
  std::vector<BrickColumn> columns() const;
  // columns() has no more than these; without a walk through them.
  std::size_t mostColumns() const { return columns_.size(); }

  // Calls visit(std::uint16_t z, const Brick&) for every brick of the column from the lowest up.
  template <class Visit>
  void forEachBrick(BrickColumn column, Visit&& visit) const;

  // The columns in which a bit has changed since the last call, also those now without a brick; in
  // the order of their first change.
  std::vector<BrickColumn> drainChangedColumns();

  // As new: for bricks of which a change that failed left nobody knows what. Which columns there were is forgotten, too.
  void restart(double resolution);
  // Whether that was done since the last call.
  bool drainRestart();

  // What is allocated, in bytes.
  std::size_t memoryUsage() const;

 private:
  // A number below kFirstMixed is a uniform brick, others are kFirstMixed + the index of a brick in
  // mixed_.
  using Handle = std::uint32_t;
  static constexpr Handle kUnknown = 0, kFree = 1, kOccupied = 2, kFirstMixed = 3;

  struct Column {
    std::uint16_t lowest = 0;  // z of the first handle
    bool changed = false;
    std::vector<Handle> handles;
  };

  static std::uint32_t packed(BrickColumn column) { return column.x << 16 | column.y; }
  static Handle uniformHandle(const Brick& content);
  static const Brick& uniformBrick(Handle handle);

  const Brick& brick(Handle handle) const {
    return handle < kFirstMixed ? uniformBrick(handle) : mixed_[handle - kFirstMixed];
  }
  Handle handleOf(BrickKey key) const;
  Handle& handleSlot(Column& column, std::uint16_t z);
  Column& changedColumn(BrickColumn column);
  void replace(BrickKey key, Handle uniform);
  Handle allocate(const Brick& content);
  void release(Handle handle);

  double resolution_;
  std::unordered_map<std::uint32_t, Column> columns_;
  std::deque<Brick> mixed_;  // growing moves none of them
  std::vector<Handle> released_;
  std::vector<BrickColumn> changed_;
  bool restarted_ = false;
};

template <class Visit>
void OccupancyBricks::forEachBrick(BrickColumn column, Visit&& visit) const {
  const auto found = columns_.find(packed(column));
  if (found == columns_.end()) return;
  std::uint16_t z = found->second.lowest;
  for (const Handle handle : found->second.handles) {
    if (handle != kUnknown) visit(z, brick(handle));
    ++z;
  }
}

}  // namespace grid_path_planner::mapping
