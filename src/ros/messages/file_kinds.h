// The kinds of files that nodes read and write, as FileFolder asks for them. What may be overwritten
// is told by its beginning: another program's YAML is none of ours.
#pragma once

#include "ros/guard/file_folder.h"

namespace grid_path_planner::nodes {

// path/waypoint_file.h: begins, comments apart, with `header:` or `waypoints:`.
const FileKind& waypointFiles();

// grid/map_file.h, map_server's YAML: begins, comments apart, with `image:`.
const FileKind& mapServerFiles();

// mapping/octree_map.h, .bt or .ot.
const FileKind& octreeFiles();

// avoidance/flight_log.h.
const FileKind& flightLogs();

// Only to be read: whatever grid/map_file.h and ros/bag.h read, simulated worlds,
// simulation/sensors/sensor_faults.h, layers/zones.h, and vision/marker_layout.h.
const FileKind& mapFiles();
const FileKind& worldFiles();
const FileKind& sensorFaultFiles();
const FileKind& zoneFiles();
const FileKind& markerLayoutFiles();

}  // namespace grid_path_planner::nodes
