#include "grid_path_planner/planners/catalogue.h"

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/search/a_star.h"
#include "grid_path_planner/search/anya.h"
#include "grid_path_planner/search/dijkstra.h"
#include "grid_path_planner/search/jump_point.h"
#include "grid_path_planner/search/theta_star.h"
#include "grid_path_planner/search/weighted_jump_point.h"

namespace grid_path_planner {

const std::vector<std::string>& plannerNames() {
  static const std::vector<std::string> names = {
      "a_star",     "weighted_jump_point", "jump_point", "dijkstra",
      "theta_star", "lazy_theta_star",     "anya",       "a_star_published"};
  return names;
}

std::string listOfPlanners() {
  std::string list;
  for (const std::string& each : plannerNames()) list += (list.empty() ? "" : ", ") + each;
  return list;
}

namespace {

std::unique_ptr<Planner> make(const std::string& name, const SearchOptions& options) {
  if (name == "a_star") return std::make_unique<AStar>(options);
  if (name == "weighted_jump_point") return std::make_unique<WeightedJumpPoint>();
  if (name == "dijkstra") return std::make_unique<Dijkstra>();
  if (name == "jump_point") return std::make_unique<JumpPoint>();
  if (name == "theta_star") return std::make_unique<ThetaStar>();
  if (name == "lazy_theta_star") return std::make_unique<ThetaStar>(ThetaStar::lazy());
  if (name == "anya") return std::make_unique<Anya>();
  if (name == "a_star_published") return std::make_unique<AStar>(AStar::published(options));
  throw InputError("planner must be one of " + listOfPlanners() + ", got '" + name + "'");
}

}  // namespace

std::unique_ptr<Planner> makePlanner(const std::string& name, const SearchOptions& options) {
  checkSearchOptions(options);
  std::unique_ptr<Planner> planner = make(name, options);
  planner->limitMemory(static_cast<std::size_t>(options.memory_limit) * 1000000);
  return planner;
}

}  // namespace grid_path_planner
