#include "grid_path_planner/grid/map_format.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>
#include <locale>
#include <sstream>

namespace grid_path_planner {

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

std::string decimalText(double value) {
  for (int digits = 1;; ++digits) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(digits);
    text << value;
    std::istringstream back(text.str());
    back.imbue(std::locale::classic());
    double read = 0.0;
    back >> read;
    if (read == value || digits >= std::numeric_limits<double>::max_digits10) return text.str();
  }
}

}  // namespace grid_path_planner
