#include "grid_path_planner/planners/planner_factory.h"

#include "grid_path_planner/base/errors.h"
#include "planners/any_angle/anya.h"
#include "planners/any_angle/polyanya.h"
#include "planners/any_angle/theta_star.h"
#include "planners/astar/a_star.h"
#include "planners/astar/dijkstra.h"
#include "planners/jump_point/jump_point.h"
#include "planners/jump_point/weighted_jump_point.h"
#include "planners/rectangles/rectangle_map_planner.h"
#include "planners/replanning/incremental_a_star.h"

namespace grid_path_planner::planners {

using base::InputError, base::OptionInfo;

namespace {

using Made = std::unique_ptr<Planner>;

struct Row {
  const char* name;
  PlannerTraits (*traits)();
  Made (*make)(const SearchOptions&);
  std::vector<std::string> (*options)();  // names, beside memory_limit
};

template <class T>
Made plain(const SearchOptions&) {
  return std::make_unique<T>();
}

template <class T>
Made withOptions(const SearchOptions& options) {
  return std::make_unique<T>(options);
}

Made dijkstra(const SearchOptions& options) {
  return std::make_unique<Dijkstra>(options.tie_break);
}

template <class Options>
std::vector<std::string> all() {
  Options options;
  std::vector<std::string> names;
  visitOptions(options, [&](const char* name, auto&, const OptionInfo&) { names.push_back(name); });
  return names;
}

std::vector<std::string> none() {
  return {};
}

std::vector<std::string> tieBreak() {
  return {"tie_break"};
}

constexpr Row kRows[] = {
    {"a_star", AStar::declaredTraits, withOptions<AStar>, all<AStarOptions>},
    {"weighted_jump_point", WeightedJumpPoint::declaredTraits, withOptions<WeightedJumpPoint>,
     all<AStarOptions>},
    {"jump_point", JumpPoint::declaredTraits, plain<JumpPoint>, none},
    {"dijkstra", Dijkstra::declaredTraits, dijkstra, tieBreak},
    {"incremental_a_star", IncrementalAStar::declaredTraits, plain<IncrementalAStar>, none},
    {"lazy_theta_star", LazyThetaStar::declaredTraits, plain<LazyThetaStar>, none},
    {"anya", Anya::declaredTraits, plain<Anya>, none},
    {"polyanya", Polyanya::declaredTraits, plain<Polyanya>, none},
    {"rectangle_map", RectangleMapPlanner::declaredTraits, withOptions<RectangleMapPlanner>,
     all<RectangleMapOptions>},
};

// Retired names and their replacements.
struct Retired {
  const char* name;
  const char* advice;
};

constexpr Retired kRetired[] = {
    {"coarse_to_fine", "is retired: take a_star or weighted_jump_point"},
    {"theta_star", "is in `grid_path study` only: take lazy_theta_star"},
    {"a_star_published", "is in `grid_path study` only: take a_star"},
};

const Row& rowOf(const std::string& name) {
  for (const Row& row : kRows)
    if (name == row.name) return row;
  for (const Retired& each : kRetired)
    if (name == each.name) throw InputError("planner '" + name + "' " + each.advice);
  throw InputError("planner must be one of " + listOfPlanners() + ", got '" + name + "'");
}

}  // namespace

const std::vector<std::string>& plannerNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Row& row : kRows) all.emplace_back(row.name);
    return all;
  }();
  return names;
}

std::string listOfPlanners() {
  std::string list;
  for (const std::string& each : plannerNames()) list += (list.empty() ? "" : ", ") + each;
  return list;
}

std::unique_ptr<Planner> makePlanner(const std::string& name, const SearchOptions& options) {
  checkSearchOptions(options);
  std::unique_ptr<Planner> planner = rowOf(name).make(options);
  planner->limitMemory(memoryLimitOf(options));
  return planner;
}

PlannerTraits traitsOf(const std::string& name) {
  return rowOf(name).traits();
}

std::vector<std::string> optionsUsedBy(const std::string& name) {
  std::vector<std::string> options = rowOf(name).options();
  options.emplace_back("memory_limit");
  return options;
}

}  // namespace grid_path_planner::planners
