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

using base::InputError;

namespace {

using Made = std::unique_ptr<Planner>;

struct Row {
  const char* name;
  PlannerTraits (*traits)();
  Made (*make)(const SearchOptions&);
  std::initializer_list<const char*> options;  // of SearchOptions, beside memory_limit
};

template <class T>
Made plain(const SearchOptions&) {
  return std::make_unique<T>();
}

template <class T>
Made withOptions(const SearchOptions& options) {
  return std::make_unique<T>(options);
}

constexpr std::initializer_list<const char*> kNone = {};
constexpr std::initializer_list<const char*> kGuided = {"heuristic", "heuristic_scale", "epsilon",
                                                        "tie_break", "landmarks"};
constexpr std::initializer_list<const char*> kOrder = {"tie_break"};
constexpr std::initializer_list<const char*> kRectangles = {"rectangle_weight", "rectangle_funnel"};

constexpr Row kRows[] = {
    {"a_star", AStar::declaredTraits, withOptions<AStar>, kGuided},
    {"weighted_jump_point", WeightedJumpPoint::declaredTraits, withOptions<WeightedJumpPoint>,
     kGuided},
    {"jump_point", JumpPoint::declaredTraits, plain<JumpPoint>, kNone},
    {"dijkstra", Dijkstra::declaredTraits, withOptions<Dijkstra>, kOrder},
    {"incremental_a_star", IncrementalAStar::declaredTraits, plain<IncrementalAStar>, kNone},
    {"lazy_theta_star", LazyThetaStar::declaredTraits, plain<LazyThetaStar>, kNone},
    {"anya", Anya::declaredTraits, plain<Anya>, kNone},
    {"polyanya", Polyanya::declaredTraits, plain<Polyanya>, kNone},
    {"rectangle_map", RectangleMapPlanner::declaredTraits, withOptions<RectangleMapPlanner>,
     kRectangles},
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
  const Row& row = rowOf(name);
  std::vector<std::string> options(row.options.begin(), row.options.end());
  options.emplace_back("memory_limit");
  return options;
}

}  // namespace grid_path_planner::planners
