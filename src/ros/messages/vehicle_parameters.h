// The description of a vehicle from the parameters below ~vehicle, as a launch file loads config/vehicles/NAME.yaml.
#pragma once

#include <ros/node_handle.h>

#include <optional>
#include <string>
#include <vector>

#include "vehicle/description.h"

namespace grid_path_planner::nodes {

// None where there is no parameter below ~vehicle. Throws InputError that names the parameter, also for one that is not known,
// and as vehicle::checkDescription().
std::optional<vehicle::Description> loadVehicle(const ros::NodeHandle& private_nh);

// The names of `options` and of those parameters, for warnUnknownParameters().
std::vector<std::string> withVehicleNames(std::vector<std::string> options);

}  // namespace grid_path_planner::nodes
