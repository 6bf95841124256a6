// A pose with a position and an orientation as YAML files of waypoints have it.
#pragma once

#include <cstddef>
#include <string>

#include "grid_path_planner/base/yaml_file.h"
#include "grid_path_planner/path/waypoint_file.h"

namespace grid_path_planner::path {

// Adds the pose at `node`, in either form of waypoint_file.h, which errors call waypoint `number`. Throws
// InputError with file and line.
void appendWaypoint(const YAML::Node& node, std::size_t number, const std::string& file,
                    WaypointFile& waypoints);

// The finite coordinate of at most `largest` at `node`, which errors call `name`. Throws InputError with file and line.
double coordinateAt(const YAML::Node& node, const std::string& name, const std::string& file,
                    double largest = kLargestCoordinate);

// "within 1e6 m of 0"
std::string withinText(double largest);

// `value` with so many decimals, of which those that are 0 are left out but for the first: other readers
// of YAML take 1e-05 for a string and 4 for an integer.
std::string yamlDecimal(double value, int decimals);
constexpr int kDecimalsOfMetres = 6, kDecimalsOfTurns = 9;  // in YAML files

// `frame` without a leading slash; empty: none.
std::string withoutSlash(std::string frame);

// Whether that can be a frame's name: neither empty nor with control characters. Precondition: withoutSlash().
bool isFrameName(const std::string& frame);

// Throws InputError with the line of `header`, which names the frame, where isFrameName() does not hold.
void checkFrameName(const YAML::Node& header, const std::string& file, const std::string& frame);

// Throws InputError naming the file, and the waypoint, where it could not be read back: none at all, a
// frame without a proper name, and numbers as above.
void checkCanBeRead(const std::string& file, const Path& path);

}  // namespace grid_path_planner::path
