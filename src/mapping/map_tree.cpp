#include "mapping/map_tree.h"

#include <cassert>

namespace grid_path_planner::mapping {

// A node's array of children is protected, and OctoMap does not delete the array with the last
// child.
struct MapTree::NodeAccess : Node {
  static octomap::AbstractOcTreeNode**& of(Node* node) { return node->*(&NodeAccess::children); }
};

MapTree::MapTree(double resolution, const OctreeOptions& model) : octomap::OcTree(resolution) {
  setModel(model);
}

MapTree::MapTree(const octomap::OcTree& tree, const OctreeOptions& model) : octomap::OcTree(tree) {
  setModel(model);
}

void MapTree::setModel(const OctreeOptions& model) {
  setOccupancyThres(model.occupancy_threshold);
  setProbHit(model.hit);
  setProbMiss(model.miss);
  setClampingThresMin(model.min);
  setClampingThresMax(model.max);
}

bool MapTree::keyOf(double coordinate, octomap::key_type& key) const {
  const double voxels = resolution_factor * coordinate, half = tree_max_val;
  if (!(voxels >= -half && voxels < half)) return false;  // NaN fails both
  const int cut = static_cast<int>(voxels);
  key = static_cast<octomap::key_type>(cut - (voxels < cut) + static_cast<int>(tree_max_val));
  return true;
}

bool MapTree::keyOf(const octomap::point3d& point, octomap::OcTreeKey& key) const {
  return keyOf(point.x(), key[0]) && keyOf(point.y(), key[1]) && keyOf(point.z(), key[2]);
}

MapTree::Node* MapTree::createRoot() {
  assert(!root);
  root = new Node();
  ++tree_size;
  size_changed = true;
  return root;
}

// A node that was made and not filled is a leaf of no evidence, which OctoMap takes for occupied, however large it is. A leaf
// that was to be divided keeps its value.
void MapTree::restoreInvariants() {
  if (root) restoreBelow(root);
  if (root && !nodeHasChildren(root)) clear();
  tree_size = calcNumNodes();
  size_changed = true;
}

void MapTree::restoreBelow(Node* node) {
  for (unsigned i = 0; i < 8 && nodeHasChildren(node); ++i) {
    Node* const below = child(node, i);
    if (!below) continue;
    restoreBelow(below);
    if (!nodeHasChildren(below) && below->getLogOdds() == 0.0F) deleteLeaf(node, i);
  }
  deleteArrayWithoutChild(node);
  if (nodeHasChildren(node)) pruneOrUpdate(node);
}

void MapTree::deleteLeaf(Node* parent, unsigned index) {
  deleteNodeChild(parent, index);
  deleteArrayWithoutChild(parent);
}

void MapTree::deleteArrayWithoutChild(Node* node) {
  if (nodeHasChildren(node)) return;
  auto& children = NodeAccess::of(node);
  delete[] children;
  children = nullptr;
}

}  // namespace grid_path_planner::mapping
