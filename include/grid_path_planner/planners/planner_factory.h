// Makes planners by name, and knows their traits and options.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/planners/planner.h"
#include "grid_path_planner/planners/search_options.h"

namespace grid_path_planner::planners {

// Names in the order in which users should see them.
const std::vector<std::string>& plannerNames();

// The names as a list for people: "a_star, dijkstra, ...".
std::string listOfPlanners();

// Throws InputError for any other name: it lists the known ones, or names the replacement of a
// retired planner.
std::unique_ptr<Planner> makePlanner(const std::string& name, const SearchOptions& options = {});

// makePlanner(), or a function that knows more names.
using PlannerMaker =
    std::function<std::unique_ptr<Planner>(const std::string& name, const SearchOptions& options)>;

// What the planner of this name can do, without making one. Throws as makePlanner() does.
PlannerTraits traitsOf(const std::string& name);

// The names of the SearchOptions that it uses. Throws as makePlanner() does.
std::vector<std::string> optionsUsedBy(const std::string& name);

}  // namespace grid_path_planner::planners
