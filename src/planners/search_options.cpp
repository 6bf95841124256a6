#include "grid_path_planner/planners/search_options.h"

namespace grid_path_planner::planners {

using base::checkOptionLimits;

std::size_t memoryLimitOf(const SearchOptions& options) {
  return static_cast<std::size_t>(options.memory_limit) * 1000000;
}

void checkSearchOptions(const SearchOptions& options) {
  checkOptionLimits(options);
  heuristicScale(options);
}

}  // namespace grid_path_planner::planners
