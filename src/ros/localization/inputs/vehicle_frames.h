// Whether tf has a sensor on the vehicle, and not where the estimate has the vehicle.
#pragma once

#include <string>
#include <vector>

#include "ros/input/frame_lookup.h"

namespace grid_path_planner::nodes {

// Throws InputError where tf leads from the vehicle's frame to the sensor's by one of `estimated`, as where the world holds
// both the map and a ship with the sensor: what is placed by the estimate confirms it.
void checkOnVehicle(const FrameLookup& transforms, const std::string& vehicle,
                    const std::string& sensor, const std::vector<std::string>& estimated);

}  // namespace grid_path_planner::nodes
