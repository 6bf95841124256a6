// Trees and bricks compared node by node.
#pragma once

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cstring>

#include "grid_path_planner/mapping/octree_map.h"

namespace grid_path_planner::test {

inline bool sameBits(float a, float b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// Every node, inner ones too: the same key, depth and bits of log odds.
inline void expectSameTree(const octomap::OcTree& tree, const octomap::OcTree& expected) {
  ASSERT_EQ(tree.size(), expected.size());
  ASSERT_EQ(tree.calcNumNodes(), tree.size());
  auto node = tree.begin_tree();
  for (auto other = expected.begin_tree(); other != expected.end_tree(); ++other, ++node) {
    ASSERT_NE(node, tree.end_tree());
    ASSERT_EQ(node.getKey(), other.getKey());
    ASSERT_EQ(node.getDepth(), other.getDepth());
    ASSERT_TRUE(sameBits(node->getLogOdds(), other->getLogOdds()))
        << node->getLogOdds() << " for " << other->getLogOdds();
  }
  double extent[6];
  tree.getMetricMin(extent[0], extent[1], extent[2]);
  expected.getMetricMin(extent[3], extent[4], extent[5]);
  ASSERT_TRUE(std::equal(extent, extent + 3, extent + 3));
  tree.getMetricMax(extent[0], extent[1], extent[2]);
  expected.getMetricMax(extent[3], extent[4], extent[5]);
  ASSERT_TRUE(std::equal(extent, extent + 3, extent + 3));
}

// The bricks know the leaves' voxels and no other.
inline void expectBricksMirrorTree(const mapping::OctreeMap& map) {
  const octomap::OcTree& tree = map.tree();
  std::size_t known = 0, occupied = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const octomap::OcTreeKey low = leaf.getIndexKey();
    const mapping::Voxel state =
        tree.isNodeOccupied(*leaf) ? mapping::Voxel::OCCUPIED : mapping::Voxel::FREE;
    const unsigned edge = 1u << (16 - leaf.getDepth());
    known += edge * edge * edge;
    occupied += state == mapping::Voxel::OCCUPIED ? edge * edge * edge : 0;
    for (unsigned i = 0; i < edge * edge * edge; ++i)
      ASSERT_EQ(map.bricks().voxel({static_cast<octomap::key_type>(low[0] + i % edge),
                                    static_cast<octomap::key_type>(low[1] + i / edge % edge),
                                    static_cast<octomap::key_type>(low[2] + i / edge / edge)}),
                state);
  }
  for (const mapping::BrickColumn& column : map.bricks().columns())
    map.bricks().forEachBrick(column, [&](std::uint16_t, const mapping::Brick& brick) {
      for (unsigned y = 0; y < 8; ++y) {
        known -= __builtin_popcountll(brick.known[y]);
        occupied -= __builtin_popcountll(brick.occupied[y]);
      }
    });
  EXPECT_EQ(known, 0u);
  EXPECT_EQ(occupied, 0u);
}

}  // namespace grid_path_planner::test
