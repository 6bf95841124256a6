#include "grid_path_planner/mapping/octree_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "mapping/insertion/scan_marks.h"
#include "mapping/random_scans.h"
#include "mapping/tree_comparison.h"
#include "support/error_text.h"
#include "support/option_laws.h"

namespace grid_path_planner::mapping {
namespace {

using octomap::OcTreeKey;
using octomap::point3d;
using test::contains;
using test::errorText;

const float kNan = std::numeric_limits<float>::quiet_NaN();

OctreeOptions tenthOfAMetre() {
  OctreeOptions options;
  options.resolution = 0.1;
  return options;
}

// The voxel at a point, as the tree says.
Voxel at(const OctreeMap& map, float x, float y, float z) {
  const octomap::OcTreeNode* node = map.tree().search(x, y, z);
  if (!node) return Voxel::UNKNOWN;
  return map.tree().isNodeOccupied(node) ? Voxel::OCCUPIED : Voxel::FREE;
}

OctreeMap mapOfRandomScans(unsigned seed, int scans, const OctreeOptions& options) {
  std::mt19937 random(seed);
  OctreeMap map(options);
  for (int i = 0; i < scans; ++i) map.insert(test::randomScan(random, options));
  return map;
}

std::vector<BrickColumn> sorted(std::vector<BrickColumn> columns) {
  std::sort(columns.begin(), columns.end(), [](const BrickColumn& a, const BrickColumn& b) {
    return std::make_pair(a.x, a.y) < std::make_pair(b.x, b.y);
  });
  return columns;
}

TEST(OctreeOptions, holdTheLawsOfOptions) {
  test::expectOptionLaws<OctreeOptions>();
}

TEST(OctreeOptions, aModelThatCannotLearnIsRefusedByName) {
  const auto refusal = [](double OctreeOptions::*option, double value) {
    OctreeOptions options;
    options.*option = value;
    return errorText([&] { OctreeMap map(options); });
  };
  EXPECT_TRUE(contains(refusal(&OctreeOptions::hit, 0.5), "sensor_model/hit"));
  EXPECT_TRUE(contains(refusal(&OctreeOptions::hit, 1.0), "sensor_model/hit"));
  EXPECT_TRUE(contains(refusal(&OctreeOptions::miss, 0.5), "sensor_model/miss"));
  EXPECT_TRUE(contains(refusal(&OctreeOptions::miss, 0.0), "sensor_model/miss"));
  EXPECT_TRUE(contains(refusal(&OctreeOptions::min, 0.5), "sensor_model/min"));
  EXPECT_TRUE(contains(refusal(&OctreeOptions::min, 0.0), "sensor_model/min"));
  EXPECT_TRUE(contains(refusal(&OctreeOptions::max, 0.4), "sensor_model/max"));
  EXPECT_TRUE(contains(refusal(&OctreeOptions::max, 1.0), "sensor_model/max"));
  EXPECT_TRUE(contains(refusal(&OctreeOptions::max_range, 0.0), "sensor_model/max_range"));
  EXPECT_TRUE(contains(refusal(&OctreeOptions::resolution, 0.0), "resolution"));
  EXPECT_TRUE(contains(refusal(&OctreeOptions::occupancy_threshold, kNan), "occupancy_threshold"));
}

TEST(OctreeMap, marksTheEndOfARayOccupiedAndTheRayFree) {
  OctreeMap map(tenthOfAMetre());
  EXPECT_EQ(map.insert({{0.05f, 0.05f, 0.05f}, {{1.05f, 0.05f, 0.05f}}, {}}), 0u);
  EXPECT_EQ(at(map, 0.05f, 0.05f, 0.05f), Voxel::FREE);
  EXPECT_EQ(at(map, 0.95f, 0.05f, 0.05f), Voxel::FREE);
  EXPECT_EQ(at(map, 1.05f, 0.05f, 0.05f), Voxel::OCCUPIED);
  EXPECT_EQ(at(map, 1.15f, 0.05f, 0.05f), Voxel::UNKNOWN);
}

TEST(OctreeMap, clearOnlyPointsClearTheRayButNotTheirVoxel) {
  OctreeMap map(tenthOfAMetre());
  map.insert({{0.05f, 0.05f, 0.05f}, {}, {{1.05f, 0.05f, 0.05f}}});
  EXPECT_EQ(at(map, 0.95f, 0.05f, 0.05f), Voxel::FREE);
  EXPECT_EQ(at(map, 1.05f, 0.05f, 0.05f), Voxel::UNKNOWN);
}

TEST(OctreeMap, pointsBeyondMaxRangeOnlyClear) {
  OctreeOptions options = tenthOfAMetre();
  options.max_range = 0.5;
  OctreeMap map(options);
  map.insert({{0.05f, 0.05f, 0.05f}, {{1.05f, 0.05f, 0.05f}}, {}});
  EXPECT_EQ(at(map, 0.45f, 0.05f, 0.05f), Voxel::FREE);
  EXPECT_EQ(at(map, 0.65f, 0.05f, 0.05f), Voxel::UNKNOWN);
  EXPECT_EQ(at(map, 1.05f, 0.05f, 0.05f), Voxel::UNKNOWN);
}

TEST(OctreeMap, pointsThatCannotBeAreLeftOutAndCountedTheOthersCount) {
  OctreeMap map(tenthOfAMetre());
  const float far = 4000.0f;
  const point3d origin(0.05f, 0.05f, 0.05f);
  EXPECT_EQ(map.insert({origin,
                        {{kNan, 0, 0}, {0, INFINITY, 0}, {1.05f, 0.05f, 0.05f}, {far, 0, 0}},
                        {{0, 0, -1e30f}}}),
            4u);
  EXPECT_EQ(at(map, 1.05f, 0.05f, 0.05f), Voxel::OCCUPIED);
}

TEST(OctreeMap, anOriginThatCannotBeIsRefusedAndChangesNothing) {
  OctreeMap map(tenthOfAMetre());
  for (const point3d& origin : {point3d(kNan, 0, 0), point3d(0, 4000, 0), point3d(0, 0, INFINITY)})
    EXPECT_TRUE(contains(errorText([&] { map.insert({origin, {{1, 1, 1}}, {}}); }), "origin"));
  EXPECT_EQ(map.tree().size(), 0u);
}

TEST(OctreeMap, emptyScansAndEmptyMapsAreNoTrouble) {
  OctreeMap map(tenthOfAMetre());
  EXPECT_EQ(map.insert({{0, 0, 0}, {}, {}}), 0u);
  map.clearBox({-1, -1, -1}, {1, 1, 1});
  map.decay(1.0);
  map.reset();
  EXPECT_EQ(map.tree().size(), 0u);
  EXPECT_TRUE(map.bricks().columns().empty());
  EXPECT_TRUE(map.bricks().drainChangedColumns().empty());
}

// One ray of 100 m at 0.01 m crosses a box of a billion voxels or more.
TEST(OctreeMap, aLongRayTakesMemoryForItsVoxelsOnly) {
  OctreeOptions options;
  options.resolution = 0.01;
  OctreeMap map(options);
  map.insert({{0, 0, 0}, {{60.0f, 55.0f, -57.0f}}, {}});
  EXPECT_GT(map.tree().size(), 10000u);
  EXPECT_LT(map.memoryUsage(), 100000000u);
  test::expectBricksMirrorTree(map);
}

// Rays of `length` metres to all sides.
Scan starOf(int rays, float length) {
  Scan scan{{0, 0, 0}, {}, {}};
  for (int i = 0; i < rays; ++i) {
    const float z = (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(rays) - 1.0f;
    const float around = 2.4f * static_cast<float>(i), flat = std::sqrt(1.0f - z * z);
    scan.hits.push_back(point3d(flat * std::cos(around), flat * std::sin(around), z) * length);
  }
  return scan;
}

// A cloud of 2.4 kB took 1.8 GB, one of 12 kB all that there was; its node aborted as it ended.
TEST(OctreeMap, fewRaysOfKilometresAreRefusedAndChangeNothing) {
  OctreeOptions options;
  OctreeMap map(options);
  map.insert(starOf(20, 3.0f));
  const std::size_t before = map.tree().size();
  EXPECT_TRUE(contains(errorText([&] { map.insert(starOf(400, 1500.0f)); }), "max_range"));
  EXPECT_EQ(map.tree().size(), before);
  EXPECT_LT(map.memoryUsage(), 50000000u) << "what it took meanwhile is given back";
  options.max_range = 10.0;
  map.setOptions(options);
  EXPECT_EQ(map.insert(starOf(400, 1500.0f)), 0u);
}

// A cloud that brought a single new voxel was left out as a whole, and the wall that came into known free space
// with it.
TEST(OctreeMap, atMemoryLimitWhatIsKnownIsKeptUpToDate) {
  OctreeOptions options = tenthOfAMetre();
  options.memory_limit = 1;
  OctreeMap map(options);
  const Scan star = starOf(200, 20.0f);
  const auto scan = [&](std::size_t i) { return Scan{{0, 0, 0}, {star.hits[i]}, {}}; };
  std::size_t scans = 0;
  while (scans < 200 && !map.isFull()) map.insert(scan(scans++));
  EXPECT_GT(scans, 10u);
  ASSERT_LT(scans, 200u);
  EXPECT_LT(map.memoryUsage(), 1500000u);
  const std::size_t nodes = map.tree().size();
  const point3d known = star.hits[0] * 0.5f;
  ASSERT_EQ(at(map, known.x(), known.y(), known.z()), Voxel::FREE);
  for (int i = 0; i < 10; ++i) map.insert({{0, 0, 0}, {known, star.hits[199] * 2.0f}, {}});
  EXPECT_TRUE(map.isFull());
  EXPECT_EQ(at(map, known.x(), known.y(), known.z()), Voxel::OCCUPIED);
  EXPECT_LT(map.tree().size(), nodes + 100) << "nothing new";
  test::expectBricksMirrorTree(map);
  options.memory_limit = 100;
  map.setOptions(options);
  map.insert(scan(199));
  EXPECT_FALSE(map.isFull());
}

// A file, or a kept map, may be larger than the limit of a node that begins with it.
TEST(OctreeMap, anObstacleIsMappedHoweverFarAboveMemoryLimitTheMapIs) {
  OctreeOptions options = tenthOfAMetre();
  OctreeMap map(options);
  const Scan star = starOf(200, 20.0f);
  map.insert(star);
  options.memory_limit = 1;
  map.setOptions(options);
  const std::size_t nodes = map.tree().size();
  ASSERT_GT(nodes, 50000u);
  const point3d known = star.hits[0] * 0.5f, end = star.hits[1];
  for (int i = 0; i < 10; ++i) map.insert({{0, 0, 0}, {known}, {end * 1.1f}});
  EXPECT_TRUE(map.isFull());
  EXPECT_EQ(at(map, known.x(), known.y(), known.z()), Voxel::OCCUPIED);
  EXPECT_EQ(at(map, end.x(), end.y(), end.z()), Voxel::OCCUPIED) << "nothing is freed";
  EXPECT_LT(map.tree().size(), nodes + 100);
  test::expectBricksMirrorTree(map);
}

TEST(ScanMarks, WordsOfBricksAndOctantsAreTheSameVoxels) {
  std::mt19937_64 random(20261127);
  for (int i = 0; i < 200; ++i) {
    OctantWords octants;
    for (std::uint64_t& word : octants) word = random() & random();
    EXPECT_EQ(octantWords(brickWords(octants)), octants);
  }
}

// Single precision has no direction for points so near to each other, but they lie in two voxels.
TEST(OctreeMap, aRayOfNoLengthEnds) {
  OctreeMap map(tenthOfAMetre());
  const float tiny = 1e-30f;
  map.insert({{-tiny, -tiny, -tiny}, {{tiny, tiny, tiny}}, {}});
  EXPECT_EQ(at(map, -0.05f, -0.05f, -0.05f), Voxel::FREE);
  EXPECT_EQ(at(map, 0.05f, 0.05f, 0.05f), Voxel::OCCUPIED);
}

TEST(OctreeMap, aMillionPointsInOneVoxelAreOneHit) {
  OctreeMap map(tenthOfAMetre());
  map.insert({{0.05f, 0.05f, 0.05f}, std::vector<point3d>(1000000, {0.55f, 0.05f, 0.05f}), {}});
  EXPECT_EQ(map.tree().search(0.55, 0.05, 0.05)->getLogOdds(), map.tree().getProbHitLog());
}

// octomap_mapping #62, #110: what has been removed stayed in the map.
TEST(OctreeMap, aVoxelFreedInTheTreeIsFreedInTheBricks) {
  OctreeMap map(tenthOfAMetre());
  const point3d origin(0.05f, 0.05f, 0.05f);
  map.insert({origin, {{1.05f, 0.05f, 0.05f}}, {}});
  const OcTreeKey key = map.tree().coordToKey(1.05, 0.05, 0.05);
  EXPECT_EQ(map.bricks().voxel(key), Voxel::OCCUPIED);
  for (int i = 0; i < 3; ++i) map.insert({origin, {{2.05f, 0.05f, 0.05f}}, {}});
  EXPECT_EQ(at(map, 1.05f, 0.05f, 0.05f), Voxel::FREE);
  EXPECT_EQ(map.bricks().voxel(key), Voxel::FREE);
}

TEST(OctreeMap, clearBoxFreesKnownVoxelsInTheBoxAndNoOthers) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const OctreeOptions options = tenthOfAMetre();
    const OctreeMap before = mapOfRandomScans(seed, 6, options);
    OctreeMap map = mapOfRandomScans(seed, 6, options);
    std::mt19937 random(seed);
    const point3d low = test::randomPoint(random, 2.0f);
    const point3d high = low + point3d(1.0f, 0.7f, 1.3f);
    map.clearBox(low, high);
    const OcTreeKey low_key = map.tree().coordToKey(low), high_key = map.tree().coordToKey(high);
    const auto inside = [&](const OcTreeKey& key) {
      bool in = true;
      for (unsigned i = 0; i < 3; ++i) in &= low_key[i] <= key[i] && key[i] <= high_key[i];
      return in;
    };
    for (auto leaf = before.tree().begin_leafs(); leaf != before.tree().end_leafs(); ++leaf) {
      if (leaf.getDepth() != 16) continue;
      const octomap::OcTreeNode* now = map.tree().search(leaf.getKey());
      ASSERT_TRUE(now);
      ASSERT_EQ(now->getLogOdds(),
                inside(leaf.getKey()) ? map.tree().getClampingThresMinLog() : leaf->getLogOdds());
    }
    test::expectBricksMirrorTree(map);
    EXPECT_EQ(map.tree().calcNumNodes(), map.tree().size());
  }
}

TEST(OctreeMap, clearBoxSplitsLargerLeavesAndPrunesWhatBecameEqual) {
  OctreeMap map(tenthOfAMetre());
  octomap::OcTree cube(0.1);
  for (float x = 0.05f; x < 1.6f; x += 0.1f)
    for (float y = 0.05f; y < 1.6f; y += 0.1f)
      for (float z = 0.05f; z < 1.6f; z += 0.1f)
        for (int i = 0; i < 6; ++i) cube.updateNode(x, y, z, true);
  map.assign(cube);
  const std::size_t pruned = map.tree().size();
  map.clearBox({0.01f, 0.01f, 0.01f}, {0.31f, 0.79f, 0.79f});
  EXPECT_GT(map.tree().size(), pruned);
  EXPECT_EQ(at(map, 0.35f, 0.75f, 0.75f), Voxel::FREE);
  EXPECT_EQ(at(map, 0.45f, 0.75f, 0.75f), Voxel::OCCUPIED);
  test::expectBricksMirrorTree(map);
  map.clearBox({-100, -100, -100}, {100, 100, 100});
  EXPECT_EQ(map.tree().size(), pruned);
  EXPECT_EQ(at(map, 0.45f, 0.75f, 0.75f), Voxel::FREE);
  test::expectBricksMirrorTree(map);
}

TEST(OctreeMap, clearBoxTakesCornersOutsideOfSpaceAndRefusesOthers) {
  OctreeMap map = mapOfRandomScans(3, 4, tenthOfAMetre());
  for (const point3d& low : {point3d(kNan, 0, 0), point3d(2, 0, 0), point3d(0, -INFINITY, 0)})
    EXPECT_TRUE(contains(errorText([&] { map.clearBox(low, {1, 1, 1}); }), "box"));
  map.clearBox({-1e9f, -1e9f, -1e9f}, {1e9f, 1e9f, 1e9f});
  for (auto leaf = map.tree().begin_leafs(); leaf != map.tree().end_leafs(); ++leaf)
    EXPECT_FALSE(map.tree().isNodeOccupied(*leaf));
}

// octomap_mapping #82: trails of what had moved.
TEST(OctreeMap, whatWasSurelyOccupiedIsUnknownAfterTheDecayTime) {
  OctreeOptions options = tenthOfAMetre();
  options.decay_time = 10.0;
  OctreeMap map(options);
  const point3d origin(0.05f, 0.05f, 0.05f);
  for (int i = 0; i < 10; ++i) map.insert({origin, {{1.05f, 0.05f, 0.05f}}, {}});
  map.insert({origin, {{0.05f, 1.05f, 0.05f}}, {}});
  for (int i = 0; i < 99; ++i) map.decay(0.1);
  EXPECT_EQ(at(map, 1.05f, 0.05f, 0.05f), Voxel::OCCUPIED);
  EXPECT_EQ(at(map, 0.05f, 1.05f, 0.05f), Voxel::UNKNOWN) << "seen once: sooner";
  for (int i = 0; i < 2; ++i) map.decay(0.1);
  EXPECT_EQ(at(map, 1.05f, 0.05f, 0.05f), Voxel::UNKNOWN);
  EXPECT_EQ(at(map, 0.55f, 0.05f, 0.05f), Voxel::FREE) << "free voxels do not fade";
  test::expectBricksMirrorTree(map);
}

TEST(OctreeMap, aVoxelSeenAgainDoesNotFade) {
  OctreeOptions options = tenthOfAMetre();
  options.decay_time = 10.0;
  OctreeMap map(options);
  const point3d origin(0.05f, 0.05f, 0.05f);
  for (int i = 0; i < 100; ++i) {
    map.insert({origin, {{1.05f, 0.05f, 0.05f}}, {}});
    map.decay(1.0);
  }
  EXPECT_EQ(at(map, 1.05f, 0.05f, 0.05f), Voxel::OCCUPIED);
}

TEST(OctreeMap, decayLeavesAWholeTreeAndNoneWhereNothingIsLeft) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    OctreeOptions options = tenthOfAMetre();
    options.decay_time = 10.0;
    OctreeMap map = mapOfRandomScans(seed, 6, options);
    map.decay(2.5);
    EXPECT_EQ(map.tree().calcNumNodes(), map.tree().size());
    test::expectBricksMirrorTree(map);
    map.insert({{0, 0, 0}, {{0.05f, 0.05f, 0.05f}}, {}});
    test::expectBricksMirrorTree(map);
  }
  OctreeOptions options = tenthOfAMetre();
  options.decay_time = 10.0;
  OctreeMap map(options);
  map.insert({{0, 0, 0}, {{0.05f, 0.05f, 0.05f}}, {}});
  map.decay(10.0);
  EXPECT_EQ(map.tree().size(), 0u);
  EXPECT_EQ(map.tree().getRoot(), nullptr);
  EXPECT_TRUE(map.bricks().columns().empty());
  for (const double seconds : {-1.0, std::nan(""), HUGE_VAL})
    EXPECT_TRUE(contains(errorText([&] { map.decay(seconds); }), "decays"));
}

TEST(OctreeMap, anotherThresholdChangesTheBricksAtOnceAnotherResolutionIsRefused) {
  OctreeMap map = mapOfRandomScans(5, 6, tenthOfAMetre());
  OctreeOptions options = tenthOfAMetre();
  options.occupancy_threshold = 0.9;
  map.setOptions(options);
  test::expectBricksMirrorTree(map);
  options.resolution = 0.2;
  EXPECT_TRUE(contains(errorText([&] { map.setOptions(options); }), "resolution"));
  EXPECT_EQ(map.options().resolution, 0.1);
}

TEST(OctreeMap, everyChangedColumnIsDrainedOnce) {
  OctreeMap map(tenthOfAMetre());
  map.insert({{0.05f, 0.05f, 0.05f}, {{1.05f, 0.05f, 0.05f}}, {}});
  EXPECT_EQ(map.bricks().drainChangedColumns().size(), 2u);
  EXPECT_TRUE(map.bricks().drainChangedColumns().empty());
  map.insert({{0.05f, 0.05f, 0.05f}, {{1.05f, 0.05f, 0.05f}}, {}});
  EXPECT_TRUE(map.bricks().drainChangedColumns().empty()) << "log odds grew, no bit changed";
  map.insert({{0.05f, 0.05f, 0.05f}, {{0.05f, 0.05f, 3.05f}}, {}});
  const std::vector<BrickColumn> changed = map.bricks().drainChangedColumns();
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0], (BrickColumn{4096, 4096}));
}

TEST(OctreeMap, afterAResetEveryColumnHasChangedAndNoneHolds) {
  OctreeMap map = mapOfRandomScans(7, 6, tenthOfAMetre());
  const auto columns = sorted(map.bricks().columns());
  map.bricks().drainChangedColumns();
  map.reset();
  EXPECT_EQ(map.tree().size(), 0u);
  EXPECT_TRUE(map.bricks().columns().empty());
  EXPECT_EQ(sorted(map.bricks().drainChangedColumns()), columns);
}

}  // namespace
}  // namespace grid_path_planner::mapping
