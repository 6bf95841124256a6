// The law of insertion: what OctoMap's own insertPointCloud makes of the same scans, to the bit.
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <iostream>
#include <random>
#include <vector>

#include "grid_path_planner/mapping/octree_map.h"
#include "mapping/random_scans.h"
#include "mapping/tree_comparison.h"

namespace grid_path_planner::mapping {
namespace {

using octomap::OcTreeKey;
using octomap::point3d;

octomap::OcTree emptyTree(const OctreeOptions& options) {
  octomap::OcTree tree(options.resolution);
  tree.setOccupancyThres(options.occupancy_threshold);
  tree.setProbHit(options.hit);
  tree.setProbMiss(options.miss);
  tree.setClampingThresMin(options.min);
  tree.setClampingThresMax(options.max);
  return tree;
}

octomap::Pointcloud cloudOf(const std::vector<point3d>& points) {
  octomap::Pointcloud cloud;
  for (const point3d& point : points) cloud.push_back(point);
  return cloud;
}

// octomap_server's insertScan, reduced to what it does to the tree.
void insertAsOctomapServer(octomap::OcTree& tree, const Scan& scan, double max_range) {
  octomap::KeySet free, hit;
  tree.computeUpdate(cloudOf(scan.hits), scan.origin, free, hit, max_range);
  octomap::KeyRay ray;
  for (point3d point : scan.clear_only) {
    if (max_range > 0.0 && (point - scan.origin).norm() > max_range)
      point = scan.origin + (point - scan.origin).normalized() * static_cast<float>(max_range);
    if (tree.computeRayKeys(scan.origin, point, ray)) free.insert(ray.begin(), ray.end());
  }
  for (const OcTreeKey& key : free)
    if (!hit.count(key)) tree.updateNode(key, false);
  for (const OcTreeKey& key : hit) tree.updateNode(key, true);
}

class InsertionLaw : public testing::TestWithParam<unsigned> {
 protected:
  InsertionLaw() : random_(GetParam()), options_(test::randomOptions(random_)) {
    std::cerr.rdbuf(nullptr);  // OctoMap warns of every point outside its range
  }
  ~InsertionLaw() override { std::cerr.rdbuf(errors_); }

  std::streambuf* errors_ = std::cerr.rdbuf();
  std::mt19937 random_;
  OctreeOptions options_;
};

TEST_P(InsertionLaw, treeIsThatOfInsertPointCloud) {
  octomap::OcTree expected = emptyTree(options_);
  OctreeMap map(options_);
  for (int i = 0; i < 12; ++i) {
    Scan scan = test::randomScan(random_, options_);
    scan.clear_only.clear();
    expected.insertPointCloud(cloudOf(scan.hits), scan.origin, options_.max_range);
    map.insert(scan);
    ASSERT_NO_FATAL_FAILURE(test::expectSameTree(map.tree(), expected)) << "scan " << i;
  }
}

TEST_P(InsertionLaw, clearOnlyPointsCountAsOctomapServersGround) {
  octomap::OcTree expected = emptyTree(options_);
  OctreeMap map(options_);
  for (int i = 0; i < 12; ++i) {
    const Scan scan = test::randomScan(random_, options_);
    insertAsOctomapServer(expected, scan, options_.max_range);
    map.insert(scan);
    ASSERT_NO_FATAL_FAILURE(test::expectSameTree(map.tree(), expected)) << "scan " << i;
    if (i % 4 == 3) {
      ASSERT_NO_FATAL_FAILURE(test::expectBricksMirrorTree(map)) << "scan " << i;
    }
  }
}

// Rays that fill their box use the dense traversal, a few long ones the sparse one.
TEST_P(InsertionLaw, densePicturesCountAsSparseOnes) {
  octomap::OcTree expected = emptyTree(options_);
  OctreeMap map(options_);
  for (int i = 0; i < 6; ++i) {
    const Scan scan = test::denseScan(random_, options_);
    insertAsOctomapServer(expected, scan, options_.max_range);
    map.insert(scan);
    ASSERT_NO_FATAL_FAILURE(test::expectSameTree(map.tree(), expected)) << "scan " << i;
  }
  test::expectBricksMirrorTree(map);
}

// Where crossings of two axes coincide, and ends lie on the borders of voxels.
TEST_P(InsertionLaw, tiesFallAlike) {
  octomap::OcTree expected = emptyTree(options_);
  OctreeMap map(options_);
  const float step = static_cast<float>(options_.resolution);
  std::uniform_int_distribution<int> halves(-24, 24);
  const auto onLattice = [&] {
    const int x = halves(random_), y = halves(random_);
    return point3d(0.5f * step * x, 0.5f * step * y, 0.5f * step * halves(random_));
  };
  for (int i = 0; i < 6; ++i) {
    Scan scan{onLattice(), {}, {}};
    for (int ray = 0; ray < 1500; ++ray)
      (ray % 2 ? scan.hits : scan.clear_only).push_back(onLattice());
    insertAsOctomapServer(expected, scan, options_.max_range);
    map.insert(scan);
    ASSERT_NO_FATAL_FAILURE(test::expectSameTree(map.tree(), expected)) << "scan " << i;
  }
}

// Where two axes are crossed by turns, and rounding decides which is first.
TEST_P(InsertionLaw, diagonalsFallAlike) {
  octomap::OcTree expected = emptyTree(options_);
  OctreeMap map(options_);
  const float step = static_cast<float>(options_.resolution);
  std::uniform_real_distribution<float> lengths(0.0f, 60.0f * step);
  for (int i = 0; i < 6; ++i) {
    Scan scan{test::randomPoint(random_, 5 * step), {}, {}};
    if (i % 2) scan.origin = point3d(scan.origin.x(), scan.origin.x(), scan.origin.x());
    for (int ray = 0; ray < 1500; ++ray) {
      const float length = lengths(random_);
      const auto along = [&] {
        return length * static_cast<float>(static_cast<int>(random_() % 3) - 1);
      };
      const float x = along(), y = along();
      (ray % 2 ? scan.hits : scan.clear_only).push_back(scan.origin + point3d(x, y, along()));
    }
    insertAsOctomapServer(expected, scan, options_.max_range);
    map.insert(scan);
    ASSERT_NO_FATAL_FAILURE(test::expectSameTree(map.tree(), expected)) << "scan " << i;
  }
}

// At the border of the keys' range, where a ray has nothing beyond it.
TEST_P(InsertionLaw, cornersOfSpaceAreLikeAnyPlace) {
  options_.resolution = 0.05;
  octomap::OcTree expected = emptyTree(options_);
  OctreeMap map(options_);
  const point3d corner(-1638.38f, 1638.38f, -1638.38f);
  for (int i = 0; i < 4; ++i) {
    Scan scan{corner + point3d(0.6f, -0.6f, 0.6f), {}, {}};
    for (int ray = 0; ray < 600; ++ray) {
      const point3d inside = test::randomPoint(random_, 0.55f);
      scan.hits.push_back(scan.origin + inside);
    }
    expected.insertPointCloud(cloudOf(scan.hits), scan.origin, options_.max_range);
    map.insert(scan);
    ASSERT_NO_FATAL_FAILURE(test::expectSameTree(map.tree(), expected)) << "scan " << i;
  }
}

// The same scan again and again saturates voxels, prunes whole regions and splits them again.
TEST_P(InsertionLaw, saturatedRegionsArePrunedAndSplitAlike) {
  octomap::OcTree expected = emptyTree(options_);
  OctreeMap map(options_);
  const Scan scans[] = {test::randomScan(random_, options_), test::randomScan(random_, options_)};
  for (int i = 0; i < 40; ++i) {
    const Scan& scan = scans[i / 10 % 2];
    insertAsOctomapServer(expected, scan, options_.max_range);
    map.insert(scan);
    ASSERT_NO_FATAL_FAILURE(test::expectSameTree(map.tree(), expected)) << "scan " << i;
  }
  test::expectBricksMirrorTree(map);
}

INSTANTIATE_TEST_SUITE_P(Seeds, InsertionLaw, testing::Range(1u, 17u));

}  // namespace
}  // namespace grid_path_planner::mapping
