// Numbers in files and messages: as short as they can be.
#pragma once

#include <string>

namespace grid_path_planner::base {

// The shortest decimal that reads back as the same double; the same in every locale.
std::string decimalText(double value);

}  // namespace grid_path_planner::base
