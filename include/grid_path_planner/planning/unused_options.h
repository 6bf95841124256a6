// Finds options that have no effect: the chosen planner does not use them, or other options disable
// them.
//
//   for (const UnusedOption& each : unusedOptions(options))
//     warn(each.name + " changes nothing with " + each.with);   // "planner jump_point"
//
// Guaranteed: no path would differ if a reported option had its default. Not guaranteed: that an
// option that is not reported makes a difference on a given map.
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::planning {

struct UnusedOption {
  std::string name;
  std::string with;  // name and value of the option that disables it

  friend bool operator==(const UnusedOption& a, const UnusedOption& b) {
    return a.name == b.name && a.with == b.with;
  }
};

// The options that differ from `defaults` and have no effect, in order of declaration.
// Precondition: checkPlannerOptions() accepts the options.
std::vector<UnusedOption> unusedOptions(const PlannerOptions& options,
                                        const PlannerOptions& defaults = {});

// The names of all options that differ from their defaults, in order of declaration.
std::vector<std::string> changedOptions(const PlannerOptions& options);

}  // namespace grid_path_planner::planning
