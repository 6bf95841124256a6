#include "fuzz/fuzz_target.h"
#include "grid/formats/drawing_file.h"
#include "grid_path_planner/base/yaml_file.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfDrawings() {
  return {
      "vector_map:\n  size: [32, 24]\n  resolution: 0.25\n  obstacles:\n"
      "    - polygon: [[1, 1], [5, 2], [3, 6]]\n    - circle: {centre: [10, 8], radius: 1.5}\n"
      "    - wall: {points: [[0, 12], [20, 12], [20, 24]], thickness: 0.5}\n",
      "{vector_map: {size: [1, 1], resolution: 1, obstacles: []}}"};
}

FUZZ_TARGET(vector_map, seedsOfDrawings) {
  mayRefuse([&] {
    const YAML::Node root = base::parseYaml(input, "fuzz.yaml");
    if (!grid::looksLikeVectorMap(root)) return;
    grid::MapFileOptions options;
    options.limits = smallLimits();
    grid::checkOccupancyValues(grid::readVectorMap(root, "fuzz.yaml", options));
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
