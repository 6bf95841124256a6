#include "grid_path_planner/planners/catalogue.h"

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/rectangles/rectangle_map_planner.h"
#include "grid_path_planner/search/a_star.h"
#include "grid_path_planner/search/anya.h"
#include "grid_path_planner/search/coarse_to_fine.h"
#include "grid_path_planner/search/dijkstra.h"
#include "grid_path_planner/search/incremental_a_star.h"
#include "grid_path_planner/search/jump_point.h"
#include "grid_path_planner/search/theta_star.h"
#include "grid_path_planner/search/weighted_jump_point.h"

namespace grid_path_planner {
namespace {

using Made = std::unique_ptr<Planner>;

struct Row {
  const char* name;
  Made (*make)(const SearchOptions&);
};

template <class T>
Made plain(const SearchOptions&) {
  return std::make_unique<T>();
}

template <class T>
Made withOptions(const SearchOptions& options) {
  return std::make_unique<T>(options);
}

Made lazyThetaStar(const SearchOptions&) {
  return std::make_unique<ThetaStar>(ThetaStar::lazy());
}

Made publishedAStar(const SearchOptions& options) {
  return std::make_unique<AStar>(AStar::published(options));
}

constexpr Row kCatalogue[] = {
    {"a_star", withOptions<AStar>},
    {"weighted_jump_point", withOptions<WeightedJumpPoint>},
    {"jump_point", plain<JumpPoint>},
    {"dijkstra", withOptions<Dijkstra>},
    {"incremental_a_star", plain<IncrementalAStar>},
    {"theta_star", plain<ThetaStar>},
    {"lazy_theta_star", lazyThetaStar},
    {"anya", plain<Anya>},
    {"rectangle_map", withOptions<RectangleMapPlanner>},
    {"coarse_to_fine", withOptions<CoarseToFine>},
    {"a_star_published", publishedAStar},
};

}  // namespace

const std::vector<std::string>& plannerNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Row& row : kCatalogue) all.emplace_back(row.name);
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
  for (const Row& row : kCatalogue) {
    if (name != row.name) continue;
    std::unique_ptr<Planner> planner = row.make(options);
    planner->limitMemory(static_cast<std::size_t>(options.memory_limit) * 1000000);
    return planner;
  }
  throw InputError("planner must be one of " + listOfPlanners() + ", got '" + name + "'");
}

}  // namespace grid_path_planner
