// Which options were set in vain: those that the chosen planner does not look at, or that other
// options leave without effect. An option that does nothing is easily taken for one that made no
// difference.
//
//   for (const UnusedOption& each : unusedOptions(options))
//     warn(each.name + " changes nothing with " + each.with);   // "planner jump_point"
//
// Guaranteed: no path would differ if an option that is named had its default. Not guaranteed: that
// an option that is not named makes a difference on a given map.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::planning {

struct UnusedOption {
  std::string name;
  std::string with;  // name and value of the option that leaves it without effect

  friend bool operator==(const UnusedOption& a, const UnusedOption& b) {
    return a.name == b.name && a.with == b.with;
  }
};

// Those that differ from their defaults and change nothing, in their order. Precondition:
// checkPlannerOptions() takes the options.
std::vector<UnusedOption> unusedOptions(const PlannerOptions& options);

// The names of all that differ from their defaults, in their order.
std::vector<std::string> changedOptions(const PlannerOptions& options);

}  // namespace grid_path_planner::planning
