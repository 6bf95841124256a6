#include "fuzz/fuzz_target.h"
#include "grid/formats/moving_ai_file.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfMaps() {
  return {"type octile\nheight 2\nwidth 3\nmap\n..@\nTG.\n",
          "type tile\r\nwidth 1\r\nheight 1\r\nmap\r\nS\r\n"};
}

FUZZ_TARGET(moving_ai_map, seedsOfMaps) {
  grid::MapFileOptions options;
  mayRefuse([&] { grid::parseMovingAi(input, "fuzz.map", options); });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
