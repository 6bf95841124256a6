// The command of a nodelet manager.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

namespace grid_path_planner::test {

// GPP_NODELET_PREFIX (scripts/test): the manager is not of this package and lacks the sanitizer that its
// nodelets were built with, which must be there before anything else is loaded.
inline std::vector<std::string> nodeletCommand(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"rosrun"};
  const char* prefix = std::getenv("GPP_NODELET_PREFIX");
  if (prefix != nullptr && *prefix != '\0') command.insert(command.end(), {"--prefix", prefix});
  command.insert(command.end(), {"nodelet", "nodelet"});
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

}  // namespace grid_path_planner::test
