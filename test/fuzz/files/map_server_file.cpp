#include "fuzz/files/fuzz_images.h"
#include "fuzz/fuzz_target.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfYaml() {
  const std::string yaml = "image: fuzz.pgm\nresolution: 0.05\norigin: [-1.5, 2.0, 0.25]\n";
  return {yaml, yaml + "mode: trinary\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
          yaml + "mode: scale\nnegate: 1\noccupied_thresh: 0.9\nfree_thresh: 0.1\n",
          yaml + "mode: raw\n", "{image: fuzz.png, resolution: 1, origin: [0, 0, 0]}"};
}

FUZZ_TARGET(map_server_file, seedsOfYaml) {
  static const std::string grey = fileOf("fuzz.pgm", encodedPicture(".pgm", 1));
  static const std::string colour = fileOf("fuzz.png", encodedPicture(".png", 4));
  mayRefuse([&] { grid::checkOccupancyValues(grid::readMapFile(fileOf("fuzz.yaml", input))); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
