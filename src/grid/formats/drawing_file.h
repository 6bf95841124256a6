// Maps drawn with lines instead of cells, so that one drawing can be had at any resolution:
//
//   vector_map:
//     size: [32, 24]        # m; x to the right, y up, from the lower left corner
//     resolution: 0.25      # m; what is used where none is asked for
//     obstacles:
//       - polygon: [[1, 1], [5, 2], [3, 6]]
//       - circle: {centre: [10, 8], radius: 1.5}
//       - wall: {points: [[0, 12], [20, 12], [20, 24]], thickness: 0.5}
//
// A cell is occupied where its centre lies in an obstacle or on its rim, and free elsewhere. A wall
// is all that is no further than half its thickness from the line through its points. Walls and
// circles thinner than the diagonal of a cell may have gaps, which is warned about. Coordinates are
// within 1e9 m of 0. Users include grid/map_file.h.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

bool looksLikeVectorMap(const YAML::Node& root);

// The map has as many whole cells as its size holds, rounded to the nearest. Throws InputError
// naming the file and the line of what is wrong.
OccupancyGrid readVectorMap(const YAML::Node& root, const std::string& file,
                            MapFileOptions& options);

}  // namespace grid_path_planner::grid
