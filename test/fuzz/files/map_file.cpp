// Any content as a map file: which reader takes it is told by the content.
#include "grid_path_planner/grid/map_file.h"
#include "fuzz/files/fuzz_images.h"
#include "fuzz/fuzz_target.h"
#include "grid_path_planner/grid/occupancy.h"
#include "support/bombs.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfMapFiles() {
  return {
      "type octile\nheight 2\nwidth 3\nmap\n..@\nTG.\n",
      encodedPicture(".tif", 1),
      test::tiffHeader(12000, 5, 1, 65000),
      encodedPicture(".pgm", 1),
      encodedPicture(".png", 4),
      "info:\n  resolution: 0.5\n  width: 2\n  height: 1\n  origin:\n    position: {x: 0, y: 0}\n"
      "    orientation: {w: 1.0}\ndata: [0, 100]\n---\n"};
}

FUZZ_TARGET(map_file, seedsOfMapFiles) {
  mayRefuse([&] { grid::checkOccupancyValues(grid::readMapFile(fileOf("fuzz", input))); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
