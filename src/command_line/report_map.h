// The line that a command prints about a map it has written.
#pragma once

#include <string>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::command_line {

// Prints a line: the file, size, resolution and origin, and how many cells are free, unknown and
// occupied.
void reportMap(const std::string& file, const grid::OccupancyGrid& map);

}  // namespace grid_path_planner::command_line
