#include "simulation/resource_path.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

namespace grid_path_planner::simulation {
namespace {

// The folders of a variable like PATH.
void appendFolders(const char* variable, std::vector<std::string>& folders) {
  const char* value = std::getenv(variable);
  std::istringstream text(value == nullptr ? "" : value);
  for (std::string folder; std::getline(text, folder, ':');)
    if (!folder.empty()) folders.push_back(folder);
}

// `name` below the first of `folders` that has it; an absolute name is found as it is.
std::string firstExisting(const std::vector<std::string>& folders, const std::string& name) {
  for (const std::string& folder : folders) {
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    std::error_code nothing_there;
    if (std::filesystem::exists(path, nothing_there)) return path.string();
  }
  return "";
}

}  // namespace

std::string resourcePath(const std::string& uri, const std::string& folder,
                         const std::string& world_folder) {
  const std::size_t scheme_end = uri.find("://");
  if (scheme_end == std::string::npos) return firstExisting({folder}, uri);
  const std::string scheme = uri.substr(0, scheme_end);
  const std::string name = uri.substr(scheme_end + 3);
  if (scheme == "file") return firstExisting({folder}, name);
  if (scheme != "model") return "";
  std::vector<std::string> folders = {world_folder, world_folder + "/.."};
  appendFolders("GAZEBO_MODEL_PATH", folders);
  appendFolders("SDF_PATH", folders);
  return firstExisting(folders, name);
}

}  // namespace grid_path_planner::simulation
