#include "grid/formats/occupancy_dump.h"

#include "fuzz/fuzz_target.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfDumps() {
  const std::string info =
      "header: \n  seq: 3\n  frame_id: \"map\"\ninfo: \n  map_load_time: {secs: 12, nsecs: 0}\n"
      "  resolution: 0.05000000074505806\n  width: 3\n  height: 2\n  origin: \n"
      "    position: {x: -1.5, y: 2.0, z: 0.0}\n    orientation: {x: 0, y: 0, z: 0, w: 1}\n";
  return {info + "data: [0, 0, 100, -1, 50, 7]\n---\n",
          info + "data:\n- 0\n- 0\n- 1\n- 2\n- 3\n- -1\n"};
}

FUZZ_TARGET(occupancy_dump, seedsOfDumps) {
  if (!grid::looksLikeOccupancyDump(input)) return;
  grid::MapFileOptions options;
  mayRefuse(
      [&] { grid::checkOccupancyValues(grid::parseOccupancyDump(input, "fuzz.txt", options)); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
