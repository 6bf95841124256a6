// Where tf has a sensor on the vehicle, and that it is not where the estimate has the vehicle.
#pragma once

#include <string>
#include <vector>

#include "ros/input/frame_lookup.h"

namespace grid_path_planner::nodes {

// Where something that is fixed on the vehicle is in another such frame: by a transform of any age, waited for up to `wait`
// seconds. Throws TransformError, Stopped.
Eigen::Isometry3d mountingIn(const FrameLookup& transforms, const std::string& target,
                             const std::string& source, double wait = 0.0,
                             const base::StopToken& stop = {});

// Throws InputError where tf leads from the vehicle's frame to the sensor's by one of `estimated`, as where the world holds
// both the map and a ship with the sensor: what is placed by the estimate confirms it.
void checkOnVehicle(const FrameLookup& transforms, const std::string& vehicle,
                    const std::string& sensor, const std::vector<std::string>& estimated);

}  // namespace grid_path_planner::nodes
