#include "mapping/insertion/tree_edits.h"

#include <algorithm>

#include "mapping/tree_to_bricks.h"

namespace grid_path_planner::mapping {
namespace {

using Node = MapTree::Node;
using octomap::OcTreeKey;

struct KeyBox {
  OcTreeKey low, high;

  bool touches(const Cube& cube) const {
    return touches(0, cube.x, cube.edge) && touches(1, cube.y, cube.edge) &&
           touches(2, cube.z, cube.edge);
  }
  bool contains(const Cube& cube) const {
    return contains(0, cube.x, cube.edge) && contains(1, cube.y, cube.edge) &&
           contains(2, cube.z, cube.edge);
  }

 private:
  bool touches(int axis, std::uint32_t from, std::uint32_t edge) const {
    return from <= high[axis] && from + edge > low[axis];
  }
  bool contains(int axis, std::uint32_t from, std::uint32_t edge) const {
    return from >= low[axis] && from + edge <= high[axis] + 1u;
  }
};

// Whether something changed.
bool freeNodes(MapTree& tree, Node* node, const Cube& cube, const KeyBox& box) {
  if (!box.touches(cube)) return false;
  if (!tree.nodeHasChildren(node)) {
    if (node->getLogOdds() == tree.getClampingThresMinLog()) return false;
    if (box.contains(cube)) {
      node->setLogOdds(tree.getClampingThresMinLog());
      return true;
    }
    tree.expandNode(node);
  }
  bool changed = false;
  for (unsigned i = 0; i < 8; ++i)
    if (Node* child = tree.child(node, i)) changed |= freeNodes(tree, child, cube.child(i), box);
  if (changed) tree.pruneOrUpdate(node);
  return changed;
}

// What the brick at `key` loses of its occupied bits.
Brick withoutOccupied(Brick brick, BrickKey key, const KeyBox& box) {
  for (std::uint32_t x = 0; x < 8; ++x)
    for (std::uint32_t y = 0; y < 8; ++y)
      for (std::uint32_t z = 0; z < 8; ++z) {
        const Cube voxel{key.x * 8u + x, key.y * 8u + y, key.z * 8u + z, 1};
        Brick::Words bit{};
        setCube(bit, voxel);
        if (box.contains(voxel)) brick.occupied[y] &= ~bit[y];
      }
  return brick;
}

void freeColumn(OccupancyBricks& bricks, BrickColumn column, const KeyBox& box) {
  std::vector<std::pair<BrickKey, Brick>> changes;  // the bricks stay while they are read
  bricks.forEachBrick(column, [&](std::uint16_t z, const Brick& brick) {
    const BrickKey key{column.x, column.y, z};
    if (box.touches({key.x * 8u, key.y * 8u, key.z * 8u, 8}))
      changes.emplace_back(key, withoutOccupied(brick, key, box));
  });
  for (const auto& change : changes) bricks.setBrick(change.first, change.second);
}

enum class Fate { SAME, CHANGED, GONE };

class Decay {
 public:
  Decay(MapTree& tree, OccupancyBricks& bricks, float loss)
      : tree_(tree), bricks_(bricks), loss_(loss) {}

  Fate fade(Node* node, const Cube& cube) {
    if (!tree_.isNodeOccupied(node)) return Fate::SAME;  // nor is anything below
    return tree_.nodeHasChildren(node) ? fadeInner(node, cube) : fadeLeaf(node, cube);
  }

 private:
  Fate fadeLeaf(Node* leaf, const Cube& cube) {
    leaf->setLogOdds(leaf->getLogOdds() - loss_);
    if (tree_.isNodeOccupied(leaf)) return Fate::CHANGED;
    fillCube(bricks_, cube, Voxel::UNKNOWN);
    return Fate::GONE;
  }

  Fate fadeInner(Node* node, const Cube& cube) {
    bool changed = false;
    for (unsigned i = 0; i < 8; ++i) {
      Node* child = tree_.child(node, i);
      if (!child) continue;
      const Fate fate = fade(child, cube.child(i));
      if (fate == Fate::GONE) tree_.deleteLeaf(node, i);
      changed |= fate != Fate::SAME;
    }
    if (!tree_.nodeHasChildren(node)) return Fate::GONE;
    if (changed) tree_.pruneOrUpdate(node);
    return changed ? Fate::CHANGED : Fate::SAME;
  }

  MapTree& tree_;
  OccupancyBricks& bricks_;
  float loss_;
};

}  // namespace

void freeBox(MapTree& tree, OccupancyBricks& bricks, const OcTreeKey& low, const OcTreeKey& high) {
  const KeyBox box{low, high};
  if (!tree.getRoot() || !freeNodes(tree, tree.getRoot(), MapTree::kSpace, box)) return;
  for (const BrickColumn& column : bricks.columns())
    if (box.touches({column.x * 8u, column.y * 8u, low[2], 8})) freeColumn(bricks, column, box);
}

void fadeOccupied(MapTree& tree, OccupancyBricks& bricks, float loss) {
  if (!tree.getRoot()) return;
  if (Decay(tree, bricks, loss).fade(tree.getRoot(), MapTree::kSpace) == Fate::GONE) tree.clear();
}

}  // namespace grid_path_planner::mapping
