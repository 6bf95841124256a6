#include "grid_path_planner/planners/rectangle_map_options.h"

namespace grid_path_planner::planners {

const std::vector<std::pair<const char*, RectangleWeight>>& choicesOf(RectangleWeight) {
  static const std::vector<std::pair<const char*, RectangleWeight>> choices = {
      {"area", RectangleWeight::AREA},
      {"border", RectangleWeight::BORDER},
      {"distance", RectangleWeight::DISTANCE},
      {"connections", RectangleWeight::CONNECTIONS},
      {"length", RectangleWeight::LENGTH}};
  return choices;
}

}  // namespace grid_path_planner::planners
