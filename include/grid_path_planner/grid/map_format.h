// What the readers and writers of the several map formats share. Users include grid/map_file.h.
#pragma once

#include <string>

#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

constexpr std::size_t kLargestMapFile = std::size_t{1} << 30;  // bytes

// The geometry of a map in `file` whose own resolution and origin are given, where `options` do not
// override them. Throws InputError naming the file for what GridGeometry refuses.
GridGeometry mapGeometry(const std::string& file, int width, int height, double resolution,
                         const Origin& origin, const MapFileOptions& options);

// Says `message` about `file` to whoever listens.
void warnAbout(const std::string& file, const std::string& message, const MapFileOptions& options);

// `file` without its last extension, if its name has one.
std::string withoutExtension(const std::string& file);

// The last extension in lower case, without the dot: "pgm"; "" where there is none.
std::string extensionOf(const std::string& file);

}  // namespace grid_path_planner::grid
