#include "simulation/sensors/laser_options.h"

namespace grid_path_planner::simulation {

const std::vector<std::pair<const char*, NoReturn>>& choicesOf(NoReturn) {
  static const std::vector<std::pair<const char*, NoReturn>> choices = {
      {"inf", NoReturn::INF}, {"range_max", NoReturn::RANGE_MAX}};
  return choices;
}

}  // namespace grid_path_planner::simulation
