#include "vision/marker_layout.h"

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfMarkerLayout() {
  return {
      "family: 36h11\ntag_size: 0.2\nplate_size: 0.25\nmarkers:\n"
      "  - {id: 0, position: [-1.3, -0.056, 0.8], rpy: [1.5707963, 0, 0]}\n"
      "  - {id: 13, position: [1e1, 0, -0.8], rpy: [1.57, 0, 3.14]}\n"};
}

// Whatever was read is a place in space for every corner.
FUZZ_TARGET(marker_layout, seedsOfMarkerLayout) {
  mayRefuse([&] {
    const vision::MarkerLayout layout = vision::readMarkerLayout(fileOf("fuzz.yaml", input));
    mustHold(!layout.panel_from_tag.empty(), "a layout has markers");
    for (const auto& [id, pose] : layout.panel_from_tag)
      for (const Eigen::Vector3d& corner : layout.cornersOf(id))
        mustHold(id >= 0 && id < 587 && corner.allFinite(), "a corner is somewhere");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
