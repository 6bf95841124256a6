// map_server's YAML file, which names an image and says where its pixels lie and what they mean.
//
//   image: site.pgm               # relative to the YAML file
//   resolution: 0.05              # metres a pixel
//   origin: [-15.1, -25.0, 0.0]   # x, y in metres and yaw in radians of the lower left corner
//   negate: 0
//   occupied_thresh: 0.65
//   free_thresh: 0.196
//   mode: trinary                 # or scale, raw
//
// A yaw of nan, as map_saver prints that of octomap_server's maps, is 0 and warned of. The last four may be missing and then are as above. Keys that are not map_server's are let be.
#pragma once

#include <string>

#include "grid_path_planner/base/yaml_file.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

// The map that `root`, the content of `file`, describes. Throws InputError naming the file and
// line.
OccupancyGrid readMapServerMap(const YAML::Node& root, const std::string& file,
                               MapFileOptions& options);

}  // namespace grid_path_planner::grid
