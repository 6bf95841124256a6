// The exception for bad arguments and bad files, which names the file, the line or the value.
#pragma once

#include <stdexcept>
#include <string>

namespace grid_path_planner::base {

// Input that cannot be used. `what()` is one sentence for a person: where, what was expected and
// what was found, e.g. "maps/site.yaml:3: resolution must be a positive number of metres, got
// -0.05".
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const std::string& file, const std::string& message)
      : std::runtime_error(file + ": " + message) {}
  // `line` counts from 1.
  InputError(const std::string& file, int line, const std::string& message)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + message) {}
};

}  // namespace grid_path_planner::base
