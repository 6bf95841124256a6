#include "layers/zones.h"

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfZones() {
  return {
      "frame_id: map\nzones:\n"
      "  - {name: quay, kind: keep_out, polygon: [[1, 1], [5, 2], [3, 6]]}\n"
      "  - {kind: slow, max_speed: 0.3, polygon: [[-8, 1], [9e3, 1.5], [9, 3], [0, 0]]}\n"};
}

// Whatever was read can be drawn, and changes nothing but cells to occupied.
FUZZ_TARGET(zones, seedsOfZones) {
  mayRefuse([&] {
    const layers::Zones zones = layers::readZones(fileOf("fuzz.yaml", input));
    grid::OccupancyGrid map(grid::GridGeometry(50, 40, 0.25, {-3.0, 1.0, 0.0}), -1);
    mustHold(layers::drawKeepOutZones(zones, map).size() <= zones.zones.size(),
             "a zone is outside once");
    for (const std::int8_t value : map.values())
      mustHold(value == -1 || value == 100, "a cell is kept out of or not");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
