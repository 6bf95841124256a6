#include "grid_path_planner/planners/a_star_options.h"

#include <cmath>

namespace grid_path_planner::planners {

using base::checkOptionLimits, base::InputError;

const std::vector<std::pair<const char*, Heuristic>>& choicesOf(Heuristic) {
  static const std::vector<std::pair<const char*, Heuristic>> choices = {
      {"zero", Heuristic::ZERO},           {"manhattan", Heuristic::MANHATTAN},
      {"chebyshev", Heuristic::CHEBYSHEV}, {"octile", Heuristic::OCTILE},
      {"euclidean", Heuristic::EUCLIDEAN}, {"blocks", Heuristic::BLOCKS},
      {"landmark", Heuristic::LANDMARK},   {"exact", Heuristic::EXACT}};
  return choices;
}

const std::vector<std::pair<const char*, TieBreak>>& choicesOf(TieBreak) {
  static const std::vector<std::pair<const char*, TieBreak>> choices = {
      {"none", TieBreak::NONE},
      {"larger_g", TieBreak::LARGER_G},
      {"cross_product", TieBreak::CROSS_PRODUCT}};
  return choices;
}

std::string adviceFor(TieBreak, const std::string& name) {
  if (name != "cross_product_published") return "";
  return "is in `grid_path study` only: take cross_product";
}

std::optional<double> heuristicScale(const AStarOptions& options) {
  if (options.heuristic_scale == "cheapest") return std::nullopt;
  std::size_t used = 0;
  double scale = -1.0;
  try {
    scale = std::stod(options.heuristic_scale, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  const bool number = used == options.heuristic_scale.size() && used > 0;
  if (!number || !std::isfinite(scale) || scale < 0.0 || scale > 65535.0)
    throw InputError("heuristic_scale must be 'cheapest' or a number from 0 to 65535, got '" +
                     options.heuristic_scale + "'");
  return scale;
}

void checkAStarOptions(const AStarOptions& options) {
  checkOptionLimits(options);
  heuristicScale(options);
  if (options.heuristic == Heuristic::LANDMARK && options.landmarks == 0)
    throw InputError("heuristic landmark needs landmarks of 1 or more, got 0");
}

}  // namespace grid_path_planner::planners
