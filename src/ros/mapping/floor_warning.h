// Whether the 2-D map shows the floor as an obstacle, as it does where nothing says which heights of
// clouds are obstacles.
#pragma once

#include <string>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/mapping/projected_map_options.h"

namespace grid_path_planner::nodes {

// A sentence where more than half of the known cells, of at least 400, are occupied, and no option (a
// lower end of the band or of clouds, a seabed, a ground filter) leaves out what is low; else "". Reads
// all of the map.
std::string floorWarning(const grid::OccupancyGrid& map,
                         const mapping::ProjectedMapOptions& options);

}  // namespace grid_path_planner::nodes
