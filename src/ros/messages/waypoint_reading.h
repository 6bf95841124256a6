// The waypoint file of a node's parameter `config_filename`, or of a goal of its action.
#pragma once

#include <string>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/path/path.h"
#include "ros/guard/node_files.h"

namespace grid_path_planner::nodes {

// `stop` ends it, and so does the end of the node. Warns where waypoints tilt. Throws InputError, Stopped.
path::Path readWaypoints(const NodeFiles& files, const std::string& filename,
                         const base::StopSource& stop = {});

}  // namespace grid_path_planner::nodes
