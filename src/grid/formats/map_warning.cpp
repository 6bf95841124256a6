#include "grid/formats/map_warning.h"

namespace grid_path_planner::grid {

void warnAbout(const std::string& file, const std::string& message, const MapFileOptions& options) {
  if (options.warn) options.warn(file + ": " + message);
}

}  // namespace grid_path_planner::grid
