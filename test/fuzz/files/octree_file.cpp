#include "fuzz/fuzz_target.h"
#include "grid_path_planner/mapping/octree_map.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::fuzz {
namespace {

std::string treeAs(const std::string& name) {
  mapping::OctreeMap map{mapping::OctreeOptions()};
  mapping::Scan scan;
  scan.hits = {{0.4f, 0.1f, 0.0f}, {0.3f, -0.2f, 0.1f}};
  map.insert(scan);
  const test::TemporaryFolder folder;
  map.save(folder.path(name));
  return test::contentOf(folder.path(name));
}

std::vector<std::string> seedsOfTrees() {
  return {treeAs("fuzz.bt"), treeAs("fuzz.ot"),
          "# Octomap OcTree file\nid OcTree\nsize 0\nres 0.1\ndata\n"};
}

FUZZ_TARGET(octree_file, seedsOfTrees) {
  const std::string file = fileOf("fuzz.tree", input);
  mayRefuse([&] { mapping::OctreeMap{mapping::OctreeOptions()}.load(file); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
