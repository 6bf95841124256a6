#include "mapping/insertion/scan_memory.h"

#include <algorithm>
#include <bitset>
#include <string>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::mapping {

using base::InputError;

namespace {

// With the allocator's share: of a node, of the array of its children, of a brick. Maps take 48 to 85 bytes a
// node, those of long thin rays the most.
constexpr std::size_t kNode = 32, kChildren = 80, kBrick = 136;
constexpr std::size_t kBytesOfNode = 65;
constexpr std::size_t kMostBytesOfBrick = 585 * kNode + 73 * kChildren + kBrick;
constexpr std::size_t kBytesAbove = 2 * (kNode + kChildren);       // of a brick, above it
constexpr std::size_t kBytesOfSplit = 24 * kNode + 3 * kChildren;  // of a leaf down to one voxel

constexpr std::size_t kAnyScansBricks = std::size_t{1} << 19;
constexpr std::size_t kBricksOfPoint = 512;                    // 120 m of voxels of 0.05 m
constexpr std::size_t kBytesOfMarks = sizeof(ScanMarks) + 48;  // with its entry in a table

std::size_t countBits(std::uint64_t word) {
  return std::bitset<64>(word).count();
}

// Of the nodes below one for an octant of a brick: those of eight voxels, and single ones.
std::size_t bytesBelow(std::uint64_t octant) {
  if (octant == 0 || octant == ~std::uint64_t{0}) return 0;
  std::size_t bytes = kChildren;
  for (unsigned i = 0; i < 8; ++i) {
    const std::uint64_t eight = octant >> (8 * i) & 0xFF;
    if (eight == 0) continue;
    bytes += kNode;
    if (eight != 0xFF) bytes += kChildren + kNode * countBits(eight);
  }
  return bytes;
}

std::size_t bytesOfVoxels(const OctantWords& octants) {
  std::size_t bytes = kBytesAbove + kNode + kChildren + kBrick;
  for (const std::uint64_t octant : octants)
    if (octant != 0) bytes += kNode + bytesBelow(octant);
  return bytes;
}

bool isEmpty(const OctantWords& octants) {
  return std::all_of(octants.begin(), octants.end(), [](std::uint64_t word) { return word == 0; });
}

// At most, but for leaves that a miss splits.
std::size_t addedBytes(const ScanMarks& marks, const Brick& brick) {
  const OctantWords known = octantWords(brick.known), occupied = octantWords(brick.occupied);
  OctantWords unseen{};
  std::size_t splits = 0;
  for (unsigned i = 0; i < 8; ++i) {
    unseen[i] = (marks.free[i] | marks.hit[i]) & ~known[i];
    splits += countBits(marks.hit[i] & known[i] & ~occupied[i]);
  }
  const std::size_t bytes = isEmpty(unseen) ? 0 : bytesOfVoxels(unseen);
  return std::min(kMostBytesOfBrick, bytes + splits * kBytesOfSplit);
}

}  // namespace

std::size_t mostCrossedBricks(std::size_t points, std::size_t memory_limit) {
  return std::min(std::max(kAnyScansBricks, kBricksOfPoint * points),
                  memory_limit / 2 / kBytesOfMarks);
}

void checkCrossedBricks(const std::vector<ScanMarks>& marks, std::size_t most) {
  if (marks.size() > most)
    throw InputError("its rays cross more than " + std::to_string(most) +
                     " bricks of 8x8x8 voxels, too many for so few points or for memory_limit: a "
                     "sensor_model/max_range that the sensor sees, or a coarser resolution, helps");
}

Space spaceLeft(const MapTree& tree, const OccupancyBricks& bricks,
                const std::vector<ScanMarks>& marks, std::size_t limit) {
  const std::size_t taken = tree.size() * kBytesOfNode;
  if (taken > limit + limit / 4) return Space::FOR_HITS;
  if (taken + marks.size() * kMostBytesOfBrick <= limit) return Space::FOR_ALL;
  std::size_t more = 0;
  for (const ScanMarks& mark : marks) more += addedBytes(mark, bricks.brick(mark.key));
  return more == 0 || taken + more <= limit ? Space::FOR_ALL : Space::FOR_KNOWN;
}

void keepWhatFits(Space space, const OccupancyBricks& bricks, std::vector<ScanMarks>& marks) {
  if (space == Space::FOR_ALL) return;
  for (ScanMarks& mark : marks) {
    const OctantWords known = octantWords(bricks.brick(mark.key).known);
    for (unsigned i = 0; i < 8; ++i) {
      mark.free[i] &= space == Space::FOR_HITS ? 0 : known[i];
      mark.hit[i] &= known[i];
    }
  }
  const auto without = [](const ScanMarks& mark) {
    return isEmpty(mark.free) && isEmpty(mark.hit);
  };
  marks.erase(std::remove_if(marks.begin(), marks.end(), without), marks.end());
}

}  // namespace grid_path_planner::mapping
