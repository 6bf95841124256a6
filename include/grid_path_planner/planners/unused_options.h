// Which options were set in vain: those that the chosen planner does not look at. An option that
// does nothing is easily taken for one that made no difference.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/planners/map_planner.h"

namespace grid_path_planner {

// Names of search options that differ from their defaults and change nothing, in their order.
// Precondition: checkPlannerOptions() takes the options.
std::vector<std::string> unusedOptions(const PlannerOptions& options);

}  // namespace grid_path_planner
