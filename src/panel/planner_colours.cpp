#include "panel/planner_colours.h"

#include <map>

namespace grid_path_planner::panel {

Colour colourOf(const std::string& planner) {
  static const std::map<std::string, Colour> colours = {
      {"weighted_jump_point", {0, 114, 178}},
      {"a_star", {230, 159, 0}},
      {"jump_point", {86, 180, 233}},
      {"dijkstra", {0, 0, 0}},
      {"incremental_a_star", {0, 158, 115}},
      {"lazy_theta_star", {204, 121, 167}},
      {"anya", {213, 94, 0}},
      {"polyanya", {240, 228, 66}},
      {"rectangle_map", {110, 60, 130}},
  };
  const auto found = colours.find(planner);
  return found == colours.end() ? Colour{128, 128, 128} : found->second;
}

}  // namespace grid_path_planner::panel
