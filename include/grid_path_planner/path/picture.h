// A picture of a map with a path on it, for people.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner {

struct PictureOptions {
  int smallest_side = 800;  // pixels: small maps are enlarged by a whole factor
  int largest_side = 4096;  // pixels: large maps are reduced
};

// Writes a PNG (by the file's extension any format OpenCV writes): free cells light, unknown grey,
// occupied dark, `expanded` cells tinted, the path thick enough to see with start and goal marked.
// +x is to the right and +y up, in the map's own axes. Throws InputError naming the file.
void writePicture(const std::string& file, const OccupancyGrid& map,
                  const OccupancyThresholds& thresholds, const Path& path,
                  const std::vector<Cell>& expanded = {}, const PictureOptions& options = {});

}  // namespace grid_path_planner
