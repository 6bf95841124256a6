// The colour of each planner where paths of several are compared: fixed, and told apart by the colour
// blind (Okabe & Ito, "Color Universal Design", 2008, with a grey).
#pragma once

#include <string>

namespace grid_path_planner::panel {

// 0...255
struct Colour {
  int red = 0, green = 0, blue = 0;
};

// That of `planner`; grey for a name that is not known here.
Colour colourOf(const std::string& planner);

}  // namespace grid_path_planner::panel
