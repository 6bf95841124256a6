// Waypoint files exactly as writeWaypointFile writes them, read without a YAML parser: in 1 us a
// waypoint instead of 100.
#pragma once

#include <optional>
#include <string>

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::path {

// The path of `text`; none where anything in it differs from that form, down to a blank, or could
// not be used, which readWaypointFile finds out with a YAML parser and tells.
std::optional<Path> plainWaypoints(const std::string& text);

}  // namespace grid_path_planner::path
