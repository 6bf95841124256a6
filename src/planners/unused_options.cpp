#include "grid_path_planner/planners/unused_options.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/planners/catalogue.h"

namespace grid_path_planner {
namespace {

// An option that has no effect while another one has certain values.
struct Rule {
  const char* option;
  const char* with;
  bool (*idle)(const PlannerOptions&);
};

bool noEstimate(const PlannerOptions& o) {
  return o.search.heuristic == Heuristic::ZERO;
}
bool noKernel(const PlannerOptions& o) {
  return o.terrain.kernel == 1;
}
bool noDiagonals(const PlannerOptions& o) {
  return o.terrain.motion.connectivity == Connectivity::FOUR;
}

// The ways out of blocked blocks are paths over the grid whatever the planner.
bool tautAlready(const PlannerOptions& o) {
  return noKernel(o) && makePlanner(o.planner)->traits().shortest;
}

constexpr Rule kRules[] = {
    {"heuristic_scale", "heuristic", noEstimate},
    {"epsilon", "heuristic", noEstimate},
    {"landmarks", "heuristic",
     [](const PlannerOptions& o) { return o.search.heuristic != Heuristic::LANDMARK; }},
    {"unknown_weight", "unknown_is_passable",
     [](const PlannerOptions& o) { return !o.terrain.unknown_is_passable; }},
    {"occupied_weight", "occupied_is_passable",
     [](const PlannerOptions& o) { return !o.terrain.occupied_is_passable; }},
    {"inflation_weight", "decay", [](const PlannerOptions& o) { return o.terrain.decay == 0.0; }},
    {"kernel_rule", "kernel", noKernel},
    {"diagonal_cost", "connectivity", noDiagonals},
    {"cut_corners", "connectivity", noDiagonals},
    {"retry_finer", "kernel", noKernel},
    {"smooth", "planner", tautAlready},
    {"fixed_z", "path_z", [](const PlannerOptions& o) { return o.path_z != PathZ::FIXED; }},
};

using NamesAndValues = std::vector<std::pair<std::string, std::string>>;

// From the lines "name: value" of optionText().
template <class Options>
NamesAndValues valuesOf(const Options& options) {
  std::istringstream text(optionText(options));
  NamesAndValues values;
  for (std::string line; std::getline(text, line);) {
    const std::size_t colon = line.find(':');
    values.emplace_back(line.substr(0, colon), line.substr(colon + 2));
  }
  return values;
}

bool concernsSearch(const std::string& option) {
  const NamesAndValues all = valuesOf(SearchOptions());
  return std::any_of(all.begin(), all.end(),
                     [&option](const auto& each) { return each.first == option; });
}

bool lookedAt(const std::string& option, const std::string& planner) {
  if (!concernsSearch(option)) return true;
  const std::vector<std::string> known = optionsUsedBy(planner);
  return std::find(known.begin(), known.end(), option) != known.end();
}

// The option that leaves this one without effect; empty: it has one.
std::string idleWith(const std::string& option, const PlannerOptions& options) {
  if (!lookedAt(option, options.planner)) return "planner";
  for (const Rule& rule : kRules)
    if (option == rule.option && rule.idle(options)) return rule.with;
  return "";
}

}  // namespace

std::vector<std::string> changedOptions(const PlannerOptions& options) {
  const NamesAndValues now = valuesOf(options), usual = valuesOf(PlannerOptions());
  std::vector<std::string> changed;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] != usual[i]) changed.push_back(now[i].first);
  return changed;
}

std::vector<UnusedOption> unusedOptions(const PlannerOptions& options) {
  const NamesAndValues all = valuesOf(options);
  std::map<std::string, std::string> values(all.begin(), all.end());
  std::vector<UnusedOption> unused;
  for (const std::string& name : changedOptions(options)) {
    const std::string with = idleWith(name, options);
    if (!with.empty()) unused.push_back({name, with + " " + values[with]});
  }
  return unused;
}

}  // namespace grid_path_planner
