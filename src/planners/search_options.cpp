#include "grid_path_planner/planners/search_options.h"

#include "base/available_memory.h"

namespace grid_path_planner::planners {

using base::checkOptionLimits, base::halfOfAvailableMemory;

std::size_t memoryLimitOf(const SearchOptions& options) {
  if (options.memory_limit == 0) return halfOfAvailableMemory();
  return static_cast<std::size_t>(options.memory_limit) * 1000000;
}

void checkSearchOptions(const SearchOptions& options) {
  checkOptionLimits(options);
  heuristicScale(options);
}

}  // namespace grid_path_planner::planners
