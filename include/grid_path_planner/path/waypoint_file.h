// The YAML file of waypoints that navigate_path replays.
//
//   header: {frame_id: map}          # optional; without it "map"
//   waypoints:
//     - position: {x: 13.5, y: -13.5, z: 4.5}
//       orientation: {x: 0.0, y: 0.0, z: 0.745, w: 0.663}
//     - {x: 13.5, y: -12.0, yaw: 1.69}   # read too; z 0 unless it is given
//
//   writeWaypointFile("waypoints.yaml", path);
//   Path same = readWaypointFile("waypoints.yaml").path;
//
// Whatever is written can be read, and gives the frame, the positions to a millionth of a metre and
// the yaws, in [-pi, pi], to a few billionths of a radian; written again it is the same to the byte. The files of the original study are read too, whose
// orientations tilt by 0.12 rad: the yaw is taken and the tilt is told. The x and y of an
// orientation may be left out, and it need not be of length 1. Keys of a waypoint or of the file that
// are not named above are passed over; second keys of one name, and others in a position, an
// orientation or the short form, such as the 5 of `{x: 1,5}`, are refused.
#pragma once

#include <string>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::path {

// Largest coordinate in a map that is taken for one, in metres.
constexpr double kLargestCoordinate = 1e6;
// The same in a frame that tf leads into the map, such as utm.
constexpr double kLargestElsewhere = 1e8;
// Of the two, that of files: frames other than "map" are asked again when they are in the map.
double largestCoordinateIn(const std::string& frame_id);

// Largest angle between the z axis of a waypoint and the vertical, in radians: beyond, where it looks
// horizontally means little.
constexpr double kLargestWaypointTilt = 0.7;

struct WaypointFile {
  Path path;
  double tilt = 0.0;  // rad, the largest of a waypoint; paths have none
};

// A leading slash of the frame is dropped. Throws InputError naming the file, the line and the
// entry (from 1) for anything but at least one waypoint with finite coordinates up to
// largestCoordinateIn(its frame) and a quaternion that can be normalised and tilts by no more than
// kLargestWaypointTilt, and for a file that needs more than `limits`.
WaypointFile readWaypointFile(const std::string& file, const base::ReadLimits& limits = {});

// Throws InputError naming the file, and the waypoint where one could not be read back: none at
// all, a coordinate beyond largestCoordinateIn(its frame) or a number that is not finite. The old file stays
// whole where the new one cannot be written (see writeFileAtomically).
void writeWaypointFile(const base::OutputFile& file, const Path& path);

}  // namespace grid_path_planner::path
