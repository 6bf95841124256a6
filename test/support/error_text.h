// What an InputError says, for tests of the sentences that people get to read.
#pragma once

#include <string>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::test {

// The text of the InputError that `action` throws, "" where it throws none.
template <class Action>
std::string errorText(const Action& action) {
  try {
    action();
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace grid_path_planner::test
