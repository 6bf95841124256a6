#include "layers/map_layers_options.h"

namespace grid_path_planner::layers {

const std::vector<std::pair<const char*, StaleSource>>& choicesOf(StaleSource) {
  static const std::vector<std::pair<const char*, StaleSource>> choices = {
      {"hold", StaleSource::HOLD}, {"drop", StaleSource::DROP}};
  return choices;
}

}  // namespace grid_path_planner::layers
