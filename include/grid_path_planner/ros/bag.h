// Reads the map that was recorded in a bag.
//
//   OccupancyGrid map = readMapFromBag("run.bag");  // first map of projected_map
//   OccupancyGrid any = readAnyMapFile("run.bag");  // or any format of readMapFile
#pragma once

#include <functional>
#include <string>

#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::nodes {

// The first nav_msgs/OccupancyGrid with cells on `topic`, a leading slash here or in the bag ignored; where that is empty, on
// projected_map, or on the only topic that has any. Throws InputError naming the file where there is no such bag, it is cut
// short, it has no such map (then naming the topics that have one), the message is no valid map, or `limits` do not allow
// for it. `warn`, where given, is told of the only topic, an origin without an orientation, and a map that is inflated.
grid::OccupancyGrid readMapFromBag(const std::string& file, const std::string& topic = "",
                                   const base::ReadLimits& limits = {},
                                   const std::function<void(const std::string&)>& warn = {});

// A map from any file: a bag (known by its content, or the extension .bag) or what readMapFile
// reads. `options` override a bag's resolution and origin too.
grid::OccupancyGrid readAnyMapFile(const std::string& file,
                                   const grid::MapFileOptions& options = {});

}  // namespace grid_path_planner::nodes
