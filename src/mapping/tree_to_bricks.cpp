#include "mapping/tree_to_bricks.h"

#include <algorithm>
#include <cassert>
#include <unordered_map>

namespace grid_path_planner::mapping {
namespace {

using Node = MapTree::Node;

constexpr std::uint32_t kBrickEdge = 8;

// What OccupancyBricks takes: a column with its entry among those that have changed, and for each brick
// between its lowest and its highest one a handle, of which there is room for twice as many.
constexpr std::size_t kBytesOfColumn = 160, kBytesOfHandle = 8;
constexpr std::size_t kBytesOfMeasured = 48;  // an entry of what bytesOfBricks() makes

// Bricks of a column, from `lowest` up to before `end`.
struct Heights {
  std::uint32_t lowest = 0xFFFF;
  std::uint32_t end = 0;
};

BrickKey brickKey(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return {static_cast<std::uint16_t>(x / kBrickEdge), static_cast<std::uint16_t>(y / kBrickEdge),
          static_cast<std::uint16_t>(z / kBrickEdge)};
}

// Calls visit(leaf, cube) for leaves larger than a brick and for the nodes that are one.
template <class Visit>
void forEachBrickNode(const MapTree& tree, const Node* node, const Cube& cube, const Visit& visit) {
  if (cube.edge == kBrickEdge || !tree.nodeHasChildren(node)) return visit(node, cube);
  for (unsigned i = 0; i < 8; ++i)
    if (tree.nodeChildExists(node, i))
      forEachBrickNode(tree, tree.getNodeChild(node, i), cube.child(i), visit);
}

void addLeaves(const MapTree& tree, const Node* node, const Cube& cube, Brick& brick) {
  if (!tree.nodeHasChildren(node)) {
    setCube(brick.known, cube);
    if (tree.isNodeOccupied(node)) setCube(brick.occupied, cube);
    return;
  }
  for (unsigned i = 0; i < 8; ++i)
    if (tree.nodeChildExists(node, i))
      addLeaves(tree, tree.getNodeChild(node, i), cube.child(i), brick);
}

}  // namespace

std::size_t countBricks(const MapTree& tree) {
  std::size_t count = 0;
  if (tree.getRoot())
    forEachBrickNode(tree, tree.getRoot(), MapTree::kSpace, [&](const Node*, const Cube& cube) {
      const std::size_t edge = cube.edge / kBrickEdge;
      count += edge * edge * edge;
    });
  return count;
}

std::size_t bytesToMeasureBricks(const MapTree& tree) {
  std::size_t columns = 0;
  if (tree.getRoot())
    forEachBrickNode(tree, tree.getRoot(), MapTree::kSpace, [&](const Node*, const Cube& cube) {
      columns += (cube.edge / kBrickEdge) * (cube.edge / kBrickEdge);
    });
  return columns * kBytesOfMeasured;
}

std::size_t bytesOfBricks(const MapTree& tree) {
  if (!tree.getRoot()) return 0;
  std::unordered_map<std::uint32_t, Heights> columns;
  std::size_t mixed = 0;
  const auto measure = [&](const Node* node, const Cube& cube) {
    mixed += tree.nodeHasChildren(node) ? 1 : 0;
    const BrickKey low = brickKey(cube.x, cube.y, cube.z);
    const std::uint32_t edge = cube.edge / kBrickEdge;
    for (std::uint32_t x = low.x; x < low.x + edge; ++x)
      for (std::uint32_t y = low.y; y < low.y + edge; ++y) {
        Heights& heights = columns[x << 16 | y];
        heights.lowest = std::min<std::uint32_t>(heights.lowest, low.z);
        heights.end = std::max(heights.end, low.z + edge);
      }
  };
  forEachBrickNode(tree, tree.getRoot(), MapTree::kSpace, measure);
  std::size_t handles = 0;
  for (const auto& [key, heights] : columns) handles += heights.end - heights.lowest;
  return mixed * sizeof(Brick) + columns.size() * kBytesOfColumn + handles * kBytesOfHandle;
}

void treeToBricks(const MapTree& tree, OccupancyBricks& bricks) {
  if (!tree.getRoot()) return;
  const auto add = [&](const Node* node, const Cube& cube) {
    if (!tree.nodeHasChildren(node))
      return fillCube(bricks, cube, tree.isNodeOccupied(node) ? Voxel::OCCUPIED : Voxel::FREE);
    Brick brick;
    addLeaves(tree, node, cube, brick);
    bricks.setBrick(brickKey(cube.x, cube.y, cube.z), brick);
  };
  forEachBrickNode(tree, tree.getRoot(), MapTree::kSpace, add);
}

void setCube(Brick::Words& words, const Cube& cube) {
  assert(cube.edge <= kBrickEdge);
  const std::uint64_t row = ((1u << cube.edge) - 1) << (cube.z & 7);
  std::uint64_t bits = 0;
  for (std::uint32_t x = 0; x < cube.edge; ++x) bits |= row << (8 * ((cube.x & 7) + x));
  for (std::uint32_t y = 0; y < cube.edge; ++y) words[(cube.y & 7) + y] |= bits;
}

void fillCube(OccupancyBricks& bricks, const Cube& cube, Voxel state) {
  if (cube.edge < kBrickEdge) {
    for (std::uint32_t x = cube.x; x < cube.x + cube.edge; ++x)
      for (std::uint32_t y = cube.y; y < cube.y + cube.edge; ++y)
        for (std::uint32_t z = cube.z; z < cube.z + cube.edge; ++z)
          bricks.setVoxel(octomap::OcTreeKey(x, y, z), state);
    return;
  }
  for (std::uint32_t x = 0; x < cube.edge; x += kBrickEdge)
    for (std::uint32_t y = 0; y < cube.edge; y += kBrickEdge)
      for (std::uint32_t z = 0; z < cube.edge; z += kBrickEdge)
        bricks.fillBrick(brickKey(cube.x + x, cube.y + y, cube.z + z), state);
}

}  // namespace grid_path_planner::mapping
