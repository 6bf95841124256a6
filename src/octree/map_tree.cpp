#include "map_tree.h"

#include <cassert>
#include <cmath>

namespace grid_path_planner {

// Nodes keep their array of children protected, and OctoMap leaves an empty one behind when the
// last child is deleted.
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
  const double scaled = std::floor(resolution_factor * coordinate) + tree_max_val;
  if (!(scaled >= 0.0 && scaled < 2.0 * tree_max_val)) return false;  // NaN fails both
  key = static_cast<octomap::key_type>(scaled);
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

void MapTree::deleteLeaf(Node* parent, unsigned index) {
  deleteNodeChild(parent, index);
  if (nodeHasChildren(parent)) return;
  auto& children = NodeAccess::of(parent);
  delete[] children;
  children = nullptr;
}

}  // namespace grid_path_planner
