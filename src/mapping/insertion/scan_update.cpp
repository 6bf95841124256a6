#include "mapping/insertion/scan_update.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace grid_path_planner::mapping {
namespace {

using Node = MapTree::Node;

// The voxels of a node with an edge of 8, 4, 2 or 1, and those of its children.
using Octant = std::uint64_t;
using Eight = std::uint8_t;
using One = bool;

bool any(const OctantWords& voxels) {
  Octant united = 0;
  for (const Octant octant : voxels) united |= octant;
  return united != 0;
}
bool all(const OctantWords& voxels) {
  Octant common = ~Octant{0};
  for (const Octant octant : voxels) common &= octant;
  return common == ~Octant{0};
}
bool any(Octant voxels) {
  return voxels != 0;
}
bool all(Octant voxels) {
  return voxels == ~Octant{0};
}
bool any(Eight voxels) {
  return voxels != 0;
}
bool all(Eight voxels) {
  return voxels == 0xFF;
}
bool any(One voxel) {
  return voxel;
}
bool all(One voxel) {
  return voxel;
}

Octant childOf(const OctantWords& voxels, unsigned i) {
  return voxels[i];
}
Eight childOf(Octant voxels, unsigned i) {
  return static_cast<Eight>(voxels >> (8 * i));
}
One childOf(Eight voxels, unsigned i) {
  return voxels >> i & 1;
}

void addChild(OctantWords& voxels, unsigned i, Octant child) {
  voxels[i] |= child;
}
void addChild(Octant& voxels, unsigned i, Eight child) {
  voxels |= Octant{child} << (8 * i);
}
void addChild(Eight& voxels, unsigned i, One child) {
  voxels = static_cast<Eight>(voxels | child << i);
}

OctantWords united(const OctantWords& a, const OctantWords& b) {
  OctantWords both;
  for (unsigned i = 0; i < 8; ++i) both[i] = a[i] | b[i];
  return both;
}
Octant united(Octant a, Octant b) {
  return a | b;
}
Eight united(Eight a, Eight b) {
  return a | b;
}
One united(One a, One b) {
  return a || b;
}

class TreeUpdate {
 public:
  TreeUpdate(MapTree& tree, OccupancyBricks& bricks)
      : tree_(tree),
        bricks_(bricks),
        hit_(tree.getProbHitLog()),
        miss_(tree.getProbMissLog()),
        least_(tree.getClampingThresMinLog()),
        most_(tree.getClampingThresMaxLog()) {}

  // `node` has an edge of 1 << level voxels, holds the marked bricks [begin, end) and is `fresh` if
  // it was made for them. Returns whether something changed, as do all functions below.
  bool updateBricks(Node* node, bool fresh, unsigned level, const ScanMarks* begin,
                    const ScanMarks* end) {
    if (level == kBrickLevel) return updateBrick(node, fresh, *begin);
    if (!fresh && !tree_.nodeHasChildren(node)) {
      if (!changesAny(node->getLogOdds(), begin, end)) return false;
      tree_.expandNode(node);
    }
    bool changed = false;
    while (begin != end) {
      const unsigned shift = 3 * (level - 1 - kBrickLevel);
      const unsigned index = begin->order >> shift & 7;
      const ScanMarks* next = begin + 1;
      while (next != end && (next->order >> shift & 7) == index) ++next;
      Node* child = tree_.child(node, index);
      const bool child_is_fresh = !child;
      if (child_is_fresh) child = tree_.createNodeChild(node, index);
      changed |= updateBricks(child, child_is_fresh, level - 1, begin, next);
      begin = next;
    }
    if (changed) tree_.pruneOrUpdate(node);
    return changed;
  }

 private:
  static constexpr unsigned kBrickLevel = 3;

  bool updateBrick(Node* node, bool fresh, const ScanMarks& marks) {
    OctantWords occupied{};
    if (!update(node, fresh, marks.free, marks.hit, occupied)) return false;
    const Brick::Words seen = brickWords(united(marks.free, marks.hit));
    const Brick::Words seen_occupied = brickWords(occupied);
    Brick brick = bricks_.brick(marks.key);
    for (unsigned y = 0; y < 8; ++y) {
      brick.known[y] |= seen[y];
      brick.occupied[y] = (brick.occupied[y] & ~seen[y]) | seen_occupied[y];
    }
    bricks_.setBrick(marks.key, brick);
    return true;
  }

  // Adds to `occupied` the marked voxels that are occupied afterwards.
  template <class Voxels>
  bool update(Node* node, bool fresh, const Voxels& free, const Voxels& hit, Voxels& occupied) {
    if (fresh || !tree_.nodeHasChildren(node)) {
      const float value = fresh ? 0.0f : node->getLogOdds();
      if (!fresh && !changes(value, any(free), any(hit))) {
        if (tree_.isNodeOccupied(node)) occupied = united(free, hit);
        return false;
      }
      if (all(free) || all(hit)) {
        node->setLogOdds(clamped(value + (all(free) ? miss_ : hit_)));
        if (tree_.isNodeOccupied(node)) occupied = united(free, hit);
        return true;
      }
      if (!fresh) tree_.expandNode(node);
    }
    if constexpr (!std::is_same_v<Voxels, One>) {
      return updateChildren(node, free, hit, occupied);
    } else {
      return false;  // a voxel has no children
    }
  }

  template <class Voxels>
  bool updateChildren(Node* node, const Voxels& free, const Voxels& hit, Voxels& occupied) {
    bool changed = false;
    for (unsigned i = 0; i < 8; ++i) {
      const auto child_free = childOf(free, i), child_hit = childOf(hit, i);
      if (!any(child_free) && !any(child_hit)) continue;
      Node* child = tree_.child(node, i);
      const bool fresh = !child;
      if (fresh) child = tree_.createNodeChild(node, i);
      std::decay_t<decltype(child_free)> child_occupied{};
      changed |= update(child, fresh, child_free, child_hit, child_occupied);
      addChild(occupied, i, child_occupied);
    }
    if (changed) tree_.pruneOrUpdate(node);
    return changed;
  }

  // Whether a leaf of this value changes by a miss or by a hit.
  bool changes(float value, bool by_miss, bool by_hit) const {
    return (by_miss && value > least_) || (by_hit && value < most_);
  }

  bool changesAny(float value, const ScanMarks* begin, const ScanMarks* end) const {
    return std::any_of(begin, end, [&](const ScanMarks& marks) {
      return changes(value, any(marks.free), any(marks.hit));
    });
  }

  float clamped(float value) const {
    return value < least_ ? least_ : value > most_ ? most_ : value;
  }

  MapTree& tree_;
  OccupancyBricks& bricks_;
  const float hit_, miss_, least_, most_;
};

}  // namespace

void updateTree(MapTree& tree, OccupancyBricks& bricks, const std::vector<ScanMarks>& marks) {
  if (marks.empty()) return;
  const bool fresh = !tree.getRoot();
  MapTree::Node* root = fresh ? tree.createRoot() : tree.getRoot();
  TreeUpdate(tree, bricks).updateBricks(root, fresh, 16, marks.data(), marks.data() + marks.size());
}

}  // namespace grid_path_planner::mapping
