#include "ros/messages/waypoint_reading.h"

#include <ros/console.h>

#include <utility>

#include "grid_path_planner/base/level_quaternion.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/guard/ending/shutdown_flag.h"
#include "ros/messages/file_kinds.h"

namespace grid_path_planner::nodes {

path::Path readWaypoints(const NodeFiles& files, const std::string& filename,
                         const base::StopSource& stop) {
  const ShutdownFlag end(stop);
  path::WaypointFile read =
      files.read("config_filename", filename, waypointFiles(), [&](const std::string& file) {
        return path::readWaypointFile(file, {{}, end.token()});
      });
  if (read.tilt > base::kLargestTilt)
    ROS_WARN_STREAM("Waypoints of " << filename << " tilt by up to " << read.tilt
                                    << " rad: the vehicle stays level, their yaw is taken");
  return std::move(read.path);
}

}  // namespace grid_path_planner::nodes
