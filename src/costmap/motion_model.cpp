#include "grid_path_planner/costmap/motion_model.h"

namespace grid_path_planner::costmap {

const std::vector<std::pair<const char*, Connectivity>>& choicesOf(Connectivity) {
  static const std::vector<std::pair<const char*, Connectivity>> choices = {
      {"8", Connectivity::EIGHT}, {"4", Connectivity::FOUR}};
  return choices;
}

const std::vector<std::pair<const char*, DiagonalCost>>& choicesOf(DiagonalCost) {
  static const std::vector<std::pair<const char*, DiagonalCost>> choices = {
      {"sqrt2", DiagonalCost::SQRT2}, {"unit", DiagonalCost::UNIT}};
  return choices;
}

}  // namespace grid_path_planner::costmap
