// The YAML file of waypoints that navigate_path replays.
//
//   header: {frame_id: map}          # optional; without it "map"
//   waypoints:
//     - position: {x: 13.5, y: -13.5, z: 4.5}
//       orientation: {x: 0.0, y: 0.0, z: 0.745, w: 0.663}
//
// Written and read back, a path is the same to the last bit of its positions. The files of the
// original study are read too.
#pragma once

#include <string>

#include "grid_path_planner/path/path.h"

namespace grid_path_planner {

// Largest coordinate that is taken for one, in metres.
constexpr double kLargestCoordinate = 1e6;

// Throws InputError naming the file, the line or the entry (from 1) for anything but at least one
// waypoint with finite coordinates below kLargestCoordinate and a quaternion that can be normalised
// and is level (no roll or pitch beyond 1e-3 rad).
Path readWaypointFile(const std::string& file);

// The old file stays whole where the new one cannot be written (see writeFileAtomically).
void writeWaypointFile(const std::string& file, const Path& path);

}  // namespace grid_path_planner
