// What the description of a vehicle says of the options of a planner.
//
//   takeFromVehicle(options, readDescription("config/vehicles/jackal.yaml"));
#pragma once

#include "grid_path_planner/planning/path_planner.h"
#include "vehicle/description.h"

namespace grid_path_planner::planning {

// Sets `footprint`, `min_turning_radius` and, where that is 0, `radius`: the inscribed radius and 0.05 m for what a vehicle is
// off its path. Throws InputError that names the option for one that contradicts the description. Precondition: the
// description was checked.
void takeFromVehicle(PlannerOptions& options, const vehicle::Description& vehicle);

}  // namespace grid_path_planner::planning
