// Octree files of a few bytes that ask for gigabytes: each is refused before that is taken.
#include <gtest/gtest.h>

#include "grid_path_planner/mapping/octree_map.h"
#include "support/bounded_run.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::mapping {
namespace {

using test::BoundedRun;
using test::contains;

constexpr int kMegabytes = 200;  // of the limit

struct Nodes {
  std::string bytes;
  std::size_t count = 1;  // with the root
};

// All children of a node `depth` levels deep, which are free and occupied by turns.
void addFullTree(int depth, Nodes& nodes) {
  nodes.count += 8;
  nodes.bytes += depth == 1 ? "\x66\x66" : "\xff\xff";
  for (int i = 0; depth > 1 && i < 8; ++i) addFullTree(depth - 1, nodes);
}

// A node with one child, the lowest, or with the one above that instead, down to a voxel.
void addChain(int depth, bool high, Nodes& nodes) {
  nodes.count += 1;
  const char label = depth == 1 ? 2 : 3;
  nodes.bytes += high ? std::string{'\0', label} : std::string{label, '\0'};
  if (depth > 1) addChain(depth - 1, high, nodes);
}

// Below a node all four columns of children, each of which goes on so down to a voxel: one at the
// bottom of space and one at its top.
void addColumns(int depth, bool high, int branching, Nodes& nodes) {
  if (branching == 0) return addChain(depth, high, nodes);
  nodes.count += 4;
  nodes.bytes += high ? std::string{'\0', '\xff'} : std::string{'\xff', '\0'};
  for (int i = 0; i < 4; ++i) addColumns(depth - 1, high, branching - 1, nodes);
}

std::string fileOf(const Nodes& nodes, const char* resolution = "0.05") {
  return "# Octomap OcTree binary file\nid OcTree\nsize " + std::to_string(nodes.count) + "\nres " +
         resolution + "\ndata\n" + nodes.bytes;
}

class TreeBombs : public testing::Test {
 protected:
  BoundedRun loading(const std::string& content) const {
    const std::string file = folder_.write("bomb.bt", content);
    base::ReadOptions options;
    options.read_memory_limit = kMegabytes;
    return test::runBounded([&] { OctreeMap(OctreeOptions()).load(file, options); });
  }
  static void expectTooLarge(const BoundedRun& run) {
    EXPECT_TRUE(run.ended) << run;
    EXPECT_TRUE(contains(run.refusal, "bomb.bt")) << run;
    EXPECT_TRUE(contains(run.refusal, "read_memory_limit")) << run;
    EXPECT_LT(run.megabytes, kMegabytes + 20.0) << run;
    EXPECT_LT(run.cpu_seconds, 30.0) << run;
  }

  const test::TemporaryFolder folder_;
};

// 170 bytes of the tree for each of the file.
TEST_F(TreeBombs, NodesAreCountedBeforeTheyAreMade) {
  Nodes nodes;
  addFullTree(8, nodes);
  EXPECT_LT(nodes.bytes.size(), 5000000u);
  expectTooLarge(loading(fileOf(nodes)));
}

// Two voxels in a column take a list of all that might be between them.
TEST_F(TreeBombs, ColumnsAsHighAsSpaceAreCountedBeforeTheyAreMade) {
  Nodes nodes;
  nodes.count += 8;
  nodes.bytes += "\xff\xff";
  for (const bool high : {false, true})
    for (int i = 0; i < 4; ++i) addColumns(15, high, 7, nodes);
  EXPECT_LT(nodes.bytes.size(), 4000000u);
  expectTooLarge(loading(fileOf(nodes)));
}

TEST_F(TreeBombs, ATreeThatFitsIsRead) {
  Nodes nodes;
  for (int level = 0; level < 11; ++level) nodes.bytes += std::string{3, '\0'};
  nodes.count += 11;
  addFullTree(5, nodes);
  const BoundedRun run = loading(fileOf(nodes));
  EXPECT_TRUE(run.ended);
  EXPECT_EQ(run.refusal, "");
  EXPECT_LT(run.megabytes, 60.0) << run;
}

}  // namespace
}  // namespace grid_path_planner::mapping
