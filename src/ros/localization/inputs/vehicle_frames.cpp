#include "ros/localization/inputs/vehicle_frames.h"

#include <algorithm>
#include <limits>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {

Eigen::Isometry3d mountingIn(const FrameLookup& transforms, const std::string& target,
                             const std::string& source, double wait, const base::StopToken& stop) {
  std_msgs::Header header;
  header.frame_id = source;
  Placing by{target, std::numeric_limits<double>::infinity(), Moving::NO};
  by.wait = wait;
  by.stop = stop;
  return transforms.place(header, by).pose;
}

void checkOnVehicle(const FrameLookup& transforms, const std::string& vehicle,
                    const std::string& sensor, const std::vector<std::string>& estimated) {
  const std::vector<std::string> between = transforms.framesBetween(vehicle, sensor);
  for (const std::string& frame : estimated)
    if (std::find(between.begin(), between.end(), frame) != between.end())
      throw base::InputError("tf has '" + sensor + "' by " + frame + ", not on the vehicle of '" +
                             vehicle + "'");
}

}  // namespace grid_path_planner::nodes
