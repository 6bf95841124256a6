#include "ros/localization/inputs/vehicle_frames.h"

#include <algorithm>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {

void checkOnVehicle(const FrameLookup& transforms, const std::string& vehicle,
                    const std::string& sensor, const std::vector<std::string>& estimated) {
  const std::vector<std::string> between = transforms.framesBetween(vehicle, sensor);
  for (const std::string& frame : estimated)
    if (std::find(between.begin(), between.end(), frame) != between.end())
      throw base::InputError("tf has '" + sensor + "' by " + frame + ", not on the vehicle of '" +
                             vehicle + "'");
}

}  // namespace grid_path_planner::nodes
