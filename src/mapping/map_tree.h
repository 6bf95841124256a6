// octomap::OcTree with access to its nodes, for changing many voxels at once.
//
// The invariants of octomap::OcTree hold as long as every change is made by its public functions and
// these: size() counts the nodes, the extent is computed again after a change of structure, and a
// node without children has no array of children.
#pragma once

#include <octomap/OcTree.h>

#include <cstdint>

#include "grid_path_planner/mapping/octree_options.h"

namespace grid_path_planner::mapping {

// A node's place: its lowest voxel and its edge in voxels.
struct Cube {
  std::uint32_t x, y, z, edge;

  Cube child(unsigned index) const {
    const std::uint32_t half = edge / 2;
    return {x + (index & 1 ? half : 0), y + (index & 2 ? half : 0), z + (index & 4 ? half : 0),
            half};
  }
};

class MapTree : public octomap::OcTree {
 public:
  using Node = octomap::OcTreeNode;
  static constexpr Cube kSpace{0, 0, 0, 1u << 16};

  // Empty.
  MapTree(double resolution, const OctreeOptions& model);
  MapTree(const octomap::OcTree& tree, const OctreeOptions& model);

  // All but the resolution.
  void setModel(const OctreeOptions& model);

  // False where the coordinate, in metres, is not finite or outside the tree's range.
  bool keyOf(double coordinate, octomap::key_type& key) const;
  bool keyOf(const octomap::point3d& point, octomap::OcTreeKey& key) const;

  // The child or null.
  Node* child(Node* node, unsigned index) const {
    return nodeChildExists(node, index) ? getNodeChild(node, index) : nullptr;
  }

  // Requires an empty tree.
  Node* createRoot();

  // Deletes `child`, a leaf, and the parent's array of children with the last of them.
  void deleteLeaf(Node* parent, unsigned index);

  // After a change that had not enough memory: what was made and not filled goes, and inner nodes have the largest value
  // below them.
  void restoreInvariants();

  // To be called after a child has changed: children that are all leaves of one value become their
  // parent's value, otherwise it takes their largest.
  void pruneOrUpdate(Node* node) {
    if (!pruneNode(node)) node->updateOccupancyChildren();
  }

 private:
  struct NodeAccess;

  void deleteArrayWithoutChild(Node* node);
  void restoreBelow(Node* node);
};

}  // namespace grid_path_planner::mapping
