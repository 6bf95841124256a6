// Trees to files and back, and files that are none.
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTreeStamped.h>

#include <random>
#include <string>

#include "grid_path_planner/mapping/octree_map.h"
#include "mapping/random_scans.h"
#include "mapping/tree_comparison.h"
#include "support/error_text.h"
#include "support/file_size_limit.h"
#include "support/mutation.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::mapping {
namespace {

using test::contains;
using test::errorText;

OctreeMap randomMap(unsigned seed) {
  std::mt19937 random(seed);
  OctreeOptions options;
  OctreeMap map(options);
  for (int i = 0; i < 8; ++i) map.insert(test::randomScan(random, options));
  return map;
}

TEST(TreeFile, logOddsComeBackToTheBit) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("tree.ot");
  const OctreeMap map = randomMap(1);
  map.save(file);
  OctreeMap loaded{OctreeOptions()};
  loaded.load(file);
  test::expectSameTree(loaded.tree(), map.tree());
  test::expectBricksMirrorTree(loaded);
}

TEST(TreeFile, binaryKeepsWhatIsOccupiedFreeAndUnknownAndLeavesTheMapAlone) {
  const test::TemporaryFolder folder;
  const OctreeMap map = randomMap(2), same = randomMap(2);
  map.save(folder.path("tree.bt"));
  test::expectSameTree(map.tree(), same.tree());
  OctreeMap loaded{OctreeOptions()};
  loaded.load(folder.path("tree.bt"));
  test::expectBricksMirrorTree(loaded);
  for (auto leaf = map.tree().begin_leafs(); leaf != map.tree().end_leafs(); ++leaf)
    ASSERT_EQ(loaded.bricks().voxel(leaf.getKey()), map.bricks().voxel(leaf.getKey()));
  loaded.save(folder.path("again.bt"));
  EXPECT_EQ(test::contentOf(folder.path("again.bt")), test::contentOf(folder.path("tree.bt")));
}

TEST(TreeFile, octomapReadsOursAndWeReadOctomaps) {
  const test::TemporaryFolder folder;
  OctreeMap map = randomMap(3);
  map.save(folder.path("ours.ot"));
  map.save(folder.path("ours.bt"));
  std::unique_ptr<octomap::AbstractOcTree> full(
      octomap::AbstractOcTree::read(folder.path("ours.ot")));
  ASSERT_TRUE(full);
  test::expectSameTree(dynamic_cast<octomap::OcTree&>(*full), map.tree());
  octomap::OcTree binary(0.3);
  ASSERT_TRUE(binary.readBinary(folder.path("ours.bt")));
  EXPECT_EQ(binary.getResolution(), 0.05);
  map.tree().write(folder.path("theirs.ot"));
  map.tree().writeBinaryConst(folder.path("theirs.bt"));
  OctreeMap loaded{OctreeOptions()};
  loaded.load(folder.path("theirs.ot"));
  test::expectSameTree(loaded.tree(), map.tree());
  loaded.load(folder.path("theirs.bt"));
  EXPECT_EQ(loaded.bricks().columns().size(), map.bricks().columns().size());
}

// What RTAB-Map and octomap_server's coloured and tracking variants save: all but OcTree was refused.
template <class Tree>
void expectToBeRead(const octomap::OcTree& tree) {
  const test::TemporaryFolder folder;
  Tree other(tree.getResolution());
  octomap::OcTree same(tree.getResolution());
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    other.updateNode(leaf.getKey(), leaf->getLogOdds());
    same.updateNode(leaf.getKey(), leaf->getLogOdds());
  }
  other.write(folder.path("other.ot"));
  other.writeBinaryConst(folder.path("other.bt"));
  same.write(folder.path("same.ot"));
  same.writeBinaryConst(folder.path("same.bt"));
  for (const char* ending : {".ot", ".bt"}) {
    OctreeMap loaded{OctreeOptions()}, expected{OctreeOptions()};
    loaded.load(folder.path(std::string("other") + ending));
    expected.load(folder.path(std::string("same") + ending));
    EXPECT_GT(loaded.tree().size(), 100u);
    test::expectSameTree(loaded.tree(), expected.tree());
  }
}

TEST(TreeFile, treesOfOtherKindsAreReadWithoutWhatIsTheirOwn) {
  const OctreeMap map = randomMap(7);
  expectToBeRead<octomap::ColorOcTree>(map.tree());
  expectToBeRead<octomap::OcTreeStamped>(map.tree());
}

TEST(TreeFile, theFilesResolutionBecomesOursAndEveryColumnHasChanged) {
  const test::TemporaryFolder folder;
  OctreeOptions options;
  options.resolution = 0.25;
  OctreeMap coarse(options);
  coarse.insert({{0, 0, 0}, {{1, 1, 1}}, {}});
  coarse.save(folder.path("coarse.bt"));
  OctreeMap map = randomMap(4);
  map.bricks().drainChangedColumns();
  const std::size_t before = map.bricks().columns().size();
  map.load(folder.path("coarse.bt"));
  EXPECT_EQ(map.options().resolution, 0.25);
  EXPECT_EQ(map.tree().getResolution(), 0.25);
  EXPECT_EQ(map.bricks().resolution(), 0.25);
  EXPECT_GE(map.bricks().drainChangedColumns().size(), before);
  map.insert({{0, 0, 0}, {{1, -1, 1}}, {}});
  test::expectBricksMirrorTree(map);
}

TEST(TreeFile, anEmptyMapComesBackEmpty) {
  const test::TemporaryFolder folder;
  for (const char* name : {"empty.bt", "empty.ot"}) {
    OctreeMap{OctreeOptions()}.save(folder.path(name));
    OctreeMap map = randomMap(1);
    map.load(folder.path(name));
    EXPECT_EQ(map.tree().size(), 0u);
    EXPECT_TRUE(map.bricks().columns().empty());
  }
}

// octomap_mapping #130: the file given was ignored without a word.
TEST(TreeFile, whatIsNoTreeIsRefusedByNameAndTheMapStays) {
  const test::TemporaryFolder folder;
  OctreeMap map = randomMap(5);
  map.save(folder.path("good.bt"));
  map.save(folder.path("good.ot"));
  const std::string bt = test::contentOf(folder.path("good.bt"));
  const std::string ot = test::contentOf(folder.path("good.ot"));
  const auto refusal = [&](const std::string& content) {
    const std::string file = folder.write("bad.bt", content);
    const std::string text = errorText([&] { map.load(file); });
    EXPECT_EQ(text.find(file), 0u) << text;
    return text;
  };
  EXPECT_TRUE(contains(refusal(""), "empty"));
  EXPECT_TRUE(contains(refusal("image: map.pgm\n"), "not an OctoMap tree"));
  EXPECT_TRUE(contains(refusal("# Octomap OcTree file\nid OcTree\n"), "inside its header"));
  EXPECT_TRUE(
      contains(refusal("# Octomap OcTree file\nid OcTree\nsize 0\nres 0\ndata\n"), "resolution"));
  EXPECT_TRUE(contains(refusal("# Octomap OcTree file\nid OcTree\nsize x\n"), "size"));
  EXPECT_TRUE(
      contains(refusal("# Octomap OcTree file\nid CountingOcTree\nsize 1\nres 0.1\ndata\n12345"),
               "another kind"));
  for (const std::string& content : {bt, ot}) {
    EXPECT_TRUE(contains(refusal(content.substr(0, content.size() - 1)), "truncated"));
    EXPECT_TRUE(contains(refusal(content + "more"), "after the tree"));
  }
  EXPECT_TRUE(contains(errorText([&] { map.load(folder.path("none.bt")); }), "none.bt"));
  test::expectSameTree(map.tree(), randomMap(5).tree());
  test::expectBricksMirrorTree(map);
}

// Four bytes can say that an eighth of space is free.
TEST(TreeFile, aLeafAsLargeAsSpaceIsRefusedAndTakesNoMemory) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write(
      "huge.bt", std::string("# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.05\ndata\n") +
                     '\x01' + '\0');
  OctreeMap map{OctreeOptions()};
  EXPECT_TRUE(contains(errorText([&] { map.load(file); }), "bricks"));
}

// A free leaf of 10 m at 0.01 m: a billion voxels.
TEST(TreeFile, aFreeHallCostsLittle) {
  const test::TemporaryFolder folder;
  std::string tree = "# Octomap OcTree binary file\nid OcTree\nsize 7\nres 0.01\ndata\n";
  for (int depth = 0; depth < 5; ++depth) tree += std::string("\0\xC0", 2);
  tree += std::string("\0\x40", 2);
  OctreeMap map{OctreeOptions()};
  map.load(folder.write("hall.bt", tree));
  EXPECT_EQ(map.tree().size(), 7u);
  EXPECT_LT(map.memoryUsage(), std::size_t{1} << 24);
}

TEST(TreeFile, damagedFilesNeverCrashNorChangeTheMap) {
  const test::TemporaryFolder folder;
  OctreeMap map = randomMap(6);
  std::mt19937 random(1);
  for (const char* name : {"good.bt", "good.ot"}) {
    map.save(folder.path(name));
    const std::string good = test::contentOf(folder.path(name));
    for (int i = 0; i < 200; ++i) {
      const std::string file = folder.write("bad", test::mutated(good, random));
      OctreeMap loaded{OctreeOptions()};
      if (errorText([&] { loaded.load(file); }).empty()) continue;  // may have been harmless
      EXPECT_EQ(loaded.tree().size(), 0u);
    }
  }
}

TEST(TreeFile, savingFailsLoudly) {
  const test::TemporaryFolder folder;
  const OctreeMap map = randomMap(7);
  EXPECT_TRUE(contains(errorText([&] { map.save(folder.path("tree.pgm")); }), ".bt or .ot"));
  EXPECT_TRUE(contains(errorText([&] { map.save(folder.path("none/tree.bt")); }), "none/tree.bt"));
  EXPECT_TRUE(test::refusedOnAFullDisk(100, [&] { map.save(folder.path("tree.ot")); }));
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace grid_path_planner::mapping
