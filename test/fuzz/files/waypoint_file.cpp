#include "grid_path_planner/path/waypoint_file.h"

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfWaypoints() {
  return {
      "header: {frame_id: map}\nwaypoints:\n  - position: {x: 13.5, y: -13.5, z: 4.5}\n"
      "    orientation: {x: 0.0, y: 0.0, z: 0.745, w: 0.663}\n"
      "  - position: {x: 1e3, y: 0, z: -0.25}\n    orientation: {z: 0.0, w: 1.0}\n",
      "header:\n  seq: 0\n  frame_id: \"/map\"\nwaypoints:\n- header: {seq: 1}\n"
      "  position:\n    x: 1\n    y: 2\n    z: 3\n  orientation: {x: 0, y: 0, z: 0, w: 1}\n",
      "header: {frame_id: //map}\nwaypoints:\n  - position: {x: 1, y: 2, z: 3}\n"
      "    orientation: {x: 0, y: 0, z: 0, w: 1}\n",
      "header: {frame_id: \"a\tmap\"}\nwaypoints:\n  - position: {x: 1, y: 2, z: 3}\n"
      "    orientation: {x: 0, y: 0, z: 0, w: 1}\n",
      "header: {frame_id: map}\nwaypoints:\n  - position: {x: 1.1111111111, y: 2, z: 3}\n"
      "    orientation: {x: 0, y: 0, z: 0, w: 1}\n"};
}

constexpr double kWrittenTo = 1e-6;  // m

// Whatever was read can be written, and read again to the micrometre that is written.
FUZZ_TARGET(waypoint_file, seedsOfWaypoints) {
  const std::string file = fileOf("fuzz.yaml", input);
  path::Path path;
  try {
    path = path::readWaypointFile(file).path;
  } catch (const base::InputError&) {
    return;
  }
  path::writeWaypointFile(file, path);
  const path::Path again = path::readWaypointFile(file).path;
  mustHold(again.frame_id == path.frame_id, "the frame is read back");
  mustHold(again.poses.size() == path.poses.size(), "all waypoints are read back");
  for (std::size_t i = 0; i < path.poses.size(); ++i)
    mustHold((again.poses[i].position - path.poses[i].position).norm() < kWrittenTo,
             "positions are read back");
}

}  // namespace
}  // namespace grid_path_planner::fuzz
