// The options of all planners. Each planner is made of those that it reads: `a_star` of AStarOptions.
#pragma once

#include <cstddef>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/planners/a_star_options.h"
#include "grid_path_planner/planners/rectangle_map_options.h"

namespace grid_path_planner::planners {

struct SearchOptions : AStarOptions, RectangleMapOptions {
  int memory_limit = 0;  // MB; of every planner; 0: half of what is available
};

template <class Visitor>
void visitOptions(SearchOptions& o, Visitor&& visit) {
  visitOptions(static_cast<AStarOptions&>(o), visit);
  visit("memory_limit", o.memory_limit,
        base::OptionInfo{
            "What planning may take, maps and costmaps counted: a map that needs more is refused "
            "before anything is taken; 0: half of what is available at the start, of the machine, "
            "the control group and ulimit -v",
            "MB", 0, 1000000});
  visitOptions(static_cast<RectangleMapOptions&>(o), visit);
}

// memory_limit in bytes, of 0 too.
std::size_t memoryLimitOf(const SearchOptions& options);

// Throws InputError naming the option.
void checkSearchOptions(const SearchOptions& options);

}  // namespace grid_path_planner::planners
