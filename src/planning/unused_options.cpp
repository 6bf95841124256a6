#include "grid_path_planner/planning/unused_options.h"

#include <algorithm>

#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "vehicle/footprint.h"

namespace grid_path_planner::planning {

using base::differingOptions, base::OptionInfo, base::valueText;
using costmap::Connectivity, costmap::DiagonalCost;
using path::PathZ;
using planners::Heuristic, planners::optionsUsedBy, planners::SearchOptions, planners::traitsOf;
using vehicle::Footprint;

namespace {

// An option that has no effect while another one has certain values.
struct Rule {
  const char* option;
  const char* with;
  bool (*unused)(const PlannerOptions&);
};

bool noEstimate(const PlannerOptions& o) {
  return o.search.heuristic == Heuristic::ZERO;
}
// weighted_jump_point makes some where no heuristic is asked for.
bool noLandmarks(const PlannerOptions& o) {
  if (o.search.heuristic == Heuristic::LANDMARK) return false;
  return o.planner != "weighted_jump_point" || o.search.heuristic != Heuristic::OCTILE;
}
bool noKernel(const PlannerOptions& o) {
  return o.costmap.kernel == 1;
}
bool noDiagonals(const PlannerOptions& o) {
  return o.costmap.motion.connectivity == Connectivity::FOUR;
}

// With a kernel the legs out of blocked blocks are paths over the grid whatever the planner.
bool shortestAlready(const PlannerOptions& o) {
  return noKernel(o) && traitsOf(o.planner).shortest;
}

constexpr Rule kRules[] = {
    {"heuristic_scale", "heuristic", noEstimate},
    {"epsilon", "heuristic", noEstimate},
    {"landmarks", "heuristic", noLandmarks},
    {"unknown_weight", "unknown_is_passable",
     [](const PlannerOptions& o) { return !o.costmap.unknown_is_passable; }},
    {"occupied_weight", "occupied_is_passable",
     [](const PlannerOptions& o) { return !o.costmap.occupied_is_passable; }},
    {"radius", "footprint",
     [](const PlannerOptions& o) {
       const Footprint footprint = Footprint::fromText("footprint", o.footprint);
       return !footprint.empty() && footprint.inscribedRadius() >= o.costmap.radius;
     }},
    {"inflation_weight", "decay", [](const PlannerOptions& o) { return o.costmap.decay == 0.0; }},
    {"kernel_rule", "kernel", noKernel},
    {"diagonal_cost", "connectivity", noDiagonals},
    {"cut_corners", "connectivity", noDiagonals},
    {"retry_finer", "kernel", noKernel},
    {"smooth", "planner", shortestAlready},
    {"smooth", "connectivity", noDiagonals},
    {"smooth", "diagonal_cost",
     [](const PlannerOptions& o) { return o.costmap.motion.diagonal_cost == DiagonalCost::UNIT; }},
    {"keep_sharp_corners", "min_turning_radius",
     [](const PlannerOptions& o) { return o.min_turning_radius == 0.0; }},
    {"waypoint_tolerance", "min_turning_radius",
     [](const PlannerOptions& o) { return o.min_turning_radius > 0.0; }},
    {"fixed_z", "path_z", [](const PlannerOptions& o) { return o.path_z != PathZ::FIXED; }},
};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool isSearchOption(const std::string& option) {
  bool found = false;
  SearchOptions search;
  visitOptions(search,
               [&](const char* name, auto&, const OptionInfo&) { found |= option == name; });
  return found;
}

bool usedBy(const std::string& option, const std::string& planner) {
  return !isSearchOption(option) || contains(optionsUsedBy(planner), option);
}

// The option because of which this one has no effect; empty: it has one.
std::string unusedBecauseOf(const std::string& option, const PlannerOptions& options) {
  if (!usedBy(option, options.planner)) return "planner";
  for (const Rule& rule : kRules)
    if (option == rule.option && rule.unused(options)) return rule.with;
  return "";
}

std::string valueOf(const std::string& option, PlannerOptions options) {
  std::string text;
  visitOptions(options, [&](const char* name, auto& value, const OptionInfo&) {
    if (option == name) text = valueText(value);
  });
  return text;
}

}  // namespace

std::vector<std::string> changedOptions(const PlannerOptions& options) {
  return differingOptions(PlannerOptions(), options);
}

std::vector<UnusedOption> unusedOptions(const PlannerOptions& options,
                                        const PlannerOptions& defaults) {
  std::vector<UnusedOption> unused;
  for (const std::string& name : differingOptions(defaults, options)) {
    const std::string with = unusedBecauseOf(name, options);
    if (!with.empty()) unused.push_back({name, with + " " + valueOf(with, options)});
  }
  return unused;
}

}  // namespace grid_path_planner::planning
