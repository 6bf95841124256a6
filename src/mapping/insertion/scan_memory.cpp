#include "mapping/insertion/scan_memory.h"

#include <algorithm>
#include <bitset>
#include <string>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::mapping {

using base::InputError;

namespace {

// Of a node, its share of its parent's array and of a brick, and the allocator's, where long rays cross
// unknown space: that takes the most memory for a node.
constexpr std::size_t kBytesOfNode = 100;
constexpr std::size_t kMostNodesOfBrick = 1 + 8 + 64 + 512;
constexpr std::size_t kNodesAbove = 2;  // of a brick, above it

std::size_t countBits(const Brick::Words& words) {
  std::size_t count = 0;
  for (const std::uint64_t word : words) count += std::bitset<64>(word).count();
  return count;
}

// At most. A voxel that becomes known is a leaf, with an inner node for each at worst.
std::size_t newNodes(const ScanMarks& marks, const Brick& brick) {
  const Brick::Words hit = brickWords(marks.hit);
  Brick::Words unseen = brickWords(marks.free);
  Brick::Words freed{};  // a hit in a free leaf may split it
  for (unsigned y = 0; y < 8; ++y) {
    unseen[y] = (unseen[y] | hit[y]) & ~brick.known[y];
    freed[y] = hit[y] & brick.known[y] & ~brick.occupied[y];
  }
  const std::size_t voxels = countBits(unseen), splits = countBits(freed);
  if (voxels + splits == 0) return 0;
  return std::min(kMostNodesOfBrick, 2 * voxels + 24 * splits) + kNodesAbove;
}

std::string megabytes(std::size_t bytes) {
  return std::to_string(bytes / 1000000) + " MB";
}

}  // namespace

void checkCrossedBricks(const std::vector<ScanMarks>& marks) {
  if (marks.size() > kMostCrossedBricks)
    throw InputError("its rays cross more than " + std::to_string(kMostCrossedBricks) +
                     " bricks of 8x8x8 voxels: a sensor_model/max_range that the sensor sees, or "
                     "a coarser resolution, helps");
}

void checkScanMemory(const MapTree& tree, const OccupancyBricks& bricks,
                     const std::vector<ScanMarks>& marks, std::size_t limit) {
  const std::size_t nodes = tree.size();
  if ((nodes + (kMostNodesOfBrick + kNodesAbove) * marks.size()) * kBytesOfNode <= limit) return;
  std::size_t more = 0;
  for (const ScanMarks& mark : marks) more += newNodes(mark, bricks.brick(mark.key));
  if (more == 0 || (nodes + more) * kBytesOfNode <= limit) return;
  throw InputError("the map takes some " + megabytes(nodes * kBytesOfNode) + " and this up to " +
                   megabytes(more * kBytesOfNode) + " more, memory_limit is " + megabytes(limit) +
                   ": a shorter sensor_model/max_range, a coarser resolution or ~reset helps");
}

}  // namespace grid_path_planner::mapping
