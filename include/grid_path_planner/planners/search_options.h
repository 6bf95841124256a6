// The options of all planners. Each planner is made of those that it reads: `a_star` of AStarOptions.
#pragma once

#include <cstddef>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/planners/a_star_options.h"
#include "grid_path_planner/planners/rectangle_map_options.h"

namespace grid_path_planner::planners {

struct SearchOptions : AStarOptions, RectangleMapOptions {
  int memory_limit = 6000;  // MB; of every planner
};

template <class Visitor>
void visitOptions(SearchOptions& o, Visitor&& visit) {
  visitOptions(static_cast<AStarOptions&>(o), visit);
  visit("memory_limit", o.memory_limit,
        base::OptionInfo{
            "What a planner may take for itself, the map not counted: it refuses a map that "
            "needs more, before it takes anything",
            "MB", 1, 1000000});
  visitOptions(static_cast<RectangleMapOptions&>(o), visit);
}

// memory_limit in bytes.
std::size_t memoryLimitOf(const SearchOptions& options);

// Throws InputError naming the option.
void checkSearchOptions(const SearchOptions& options);

}  // namespace grid_path_planner::planners
