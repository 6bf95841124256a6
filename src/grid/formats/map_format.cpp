#include "grid_path_planner/grid/map_format.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace grid_path_planner::grid {

using base::InputError;

GridGeometry mapGeometry(const std::string& file, int width, int height, double resolution,
                         const Origin& origin, const MapFileOptions& options) {
  try {
    return GridGeometry(width, height, options.resolution.value_or(resolution),
                        options.origin.value_or(origin));
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
}

void warnAbout(const std::string& file, const std::string& message, const MapFileOptions& options) {
  if (options.warn) options.warn(file + ": " + message);
}

std::string withoutExtension(const std::string& file) {
  return std::filesystem::path(file).replace_extension().string();
}

std::string extensionOf(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

}  // namespace grid_path_planner::grid
