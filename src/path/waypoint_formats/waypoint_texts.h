// The texts of waypoint files, read and written, a source for each format (waypoint_formats.h).
#pragma once

#include <optional>
#include <string>

#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/path/path.h"
#include "path/waypoint_formats/local_tangent_plane.h"

namespace grid_path_planner::path {

// What is read, `file` being what errors call it. Yaws that the text does not give are NaN.
struct WaypointText {
  const std::string& content;
  const std::string& file;
  base::ReadLimits& limits;
};

// Throw InputError with file and line.
Path uuvPath(const WaypointText& text);
Path poseArrayPath(const WaypointText& text);
Path csvPath(const WaypointText& text);
Path geojsonPath(const WaypointText& text, const Datum& datum);

// Precondition: checkCanBeRead() and isPlainFrame().
std::string uuvText(const Path& path, double speed);
std::string poseArrayText(const Path& path);
std::string csvText(const Path& path);
std::string geojsonText(const Path& path, const Datum& datum);

// Of letters, digits and _ / - . alone, so that it is itself in every format.
bool isPlainFrame(const std::string& frame);

}  // namespace grid_path_planner::path
