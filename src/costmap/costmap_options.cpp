#include "grid_path_planner/costmap/costmap_options.h"

#include <algorithm>
#include <string>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::costmap {

using base::checkOptionLimits, base::InputError;

const std::vector<std::pair<const char*, KernelRule>>& choicesOf(KernelRule) {
  static const std::vector<std::pair<const char*, KernelRule>> choices = {
      {"conservative", KernelRule::CONSERVATIVE}, {"filter2d", KernelRule::FILTER2D}};
  return choices;
}

const std::vector<std::pair<const char*, Outside>>& choicesOf(Outside) {
  static const std::vector<std::pair<const char*, Outside>> choices = {
      {"free", Outside::FREE}, {"unknown", Outside::UNKNOWN}, {"occupied", Outside::OCCUPIED}};
  return choices;
}

KeptDistances keptDistances(const CostmapOptions& options) {
  KeptDistances kept;
  kept.occupied = options.occupied_is_passable ? -1.0 : options.radius;
  kept.unknown = options.radius_to_unknown;
  if (kept.unknown < 0.0) kept.unknown = options.unknown_is_passable ? -1.0 : options.radius;
  if (kept.unknown == 0.0 && options.unknown_is_passable) kept.unknown = -1.0;
  if (options.outside == Outside::UNKNOWN) kept.outside = std::max(0.0, kept.unknown);
  if (options.outside == Outside::OCCUPIED) kept.outside = options.radius;
  return kept;
}

void checkCostmapOptions(const CostmapOptions& options) {
  checkOptionLimits(options);
  if (options.thresholds.free_max >= options.thresholds.occupied_min)
    throw InputError("free_max must be below occupied_min, got " +
                     std::to_string(options.thresholds.free_max) + " and " +
                     std::to_string(options.thresholds.occupied_min));
  if (options.occupied_is_passable && options.radius > 0.0)
    throw InputError("occupied_is_passable needs radius 0, got radius " +
                     std::to_string(options.radius) + " m");
}

}  // namespace grid_path_planner::costmap
