#include "localization/filter_options.h"

namespace grid_path_planner::localization {

const std::vector<std::pair<const char*, Gate>>& choicesOf(Gate) {
  static const std::vector<std::pair<const char*, Gate>> kChoices = {
      {"chi_squared", Gate::CHI_SQUARED},
      {"either", Gate::EITHER},
      {"both", Gate::BOTH},
      {"none", Gate::NONE}};
  return kChoices;
}

}  // namespace grid_path_planner::localization
