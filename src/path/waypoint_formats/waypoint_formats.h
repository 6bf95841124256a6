// Waypoints in the formats of other programs.
//
//   Path path = readWaypoints("survey.geojson", WaypointFormat::GEOJSON, datum);
//   writeWaypoints("survey.csv", WaypointFormat::CSV, path, {});
//
// PLANNER     waypoint_file.h
// UUV         the waypoint file of UUV simulator: point, max_forward_speed, heading, use_fixed_heading. Of
//             world_ned north, east and down become y, x and -z. A heading that is not fixed is added to
//             the direction of the path. Speeds are not kept.
// POSE_ARRAY  geometry_msgs/PoseArray or nav_msgs/Path as `rostopic echo` prints it; all poses are in the frame of its header
// CSV         x,y[,z[,yaw]] or x,y,z,qx,qy,qz,qw a line, as follow_waypoints saves it, or a first line that names such columns,
//             and roll and pitch, in any order; `# frame_id: map`
// GEOJSON     points and lines (RFC 7946) with longitude, latitude and altitude, by a datum; without an
//             altitude z is 0. The property `yaw` is a number, or a list with one for each position, in
//             radians anticlockwise from east.
//
// Where a format gives no yaw, the vehicle looks along the path. Positions beyond largestCoordinateIn(the frame) and
// numbers that are not finite are refused in both directions.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/path/path.h"
#include "path/waypoint_formats/local_tangent_plane.h"

namespace grid_path_planner::path {

enum class WaypointFormat { PLANNER, UUV, POSE_ARRAY, CSV, GEOJSON };
const std::vector<std::pair<const char*, WaypointFormat>>& choicesOf(WaypointFormat);

// By its name, and of YAML files by their first keys. Throws InputError naming the file where neither
// tells.
WaypointFormat waypointFormatOf(const std::string& file, const base::ReadLimits& limits = {});

// Throws InputError naming file and line for what is no such file, holds no waypoint or needs more than
// `limits`, and for GEOJSON without a datum.
Path readWaypoints(const std::string& file, WaypointFormat format,
                   const std::optional<Datum>& datum, const base::ReadLimits& limits = {});

// What a file says beyond the path.
struct WaypointWriting {
  std::optional<Datum> datum;  // GEOJSON needs one
  double speed = 0.5;          // m/s, UUV's max_forward_speed
};

// Throws InputError as writeWaypointFile() does, and for GEOJSON without a datum.
void writeWaypoints(const base::OutputFile& file, WaypointFormat format, const Path& path,
                    const WaypointWriting& writing);

}  // namespace grid_path_planner::path
