// Warnings of the readers of map files.
#pragma once

#include <string>

#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

// Calls options.warn, where there is one, with `message` about `file`.
void warnAbout(const std::string& file, const std::string& message, const MapFileOptions& options);

}  // namespace grid_path_planner::grid
