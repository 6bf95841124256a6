#include "mapping/tree_to_bricks.h"

#include <algorithm>
#include <cassert>

namespace grid_path_planner::mapping {
namespace {

using Node = MapTree::Node;

constexpr std::uint32_t kBrickEdge = 8;

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
