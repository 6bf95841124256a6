#include "grid_path_planner/planners/unused_options.h"

#include <algorithm>
#include <sstream>

#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/planners/catalogue.h"

namespace grid_path_planner {
namespace {

// The lines "name: value" of optionText().
std::vector<std::string> linesOf(const SearchOptions& options) {
  std::istringstream text(optionText(options));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

bool used(const std::string& option, const PlannerOptions& options) {
  const std::vector<std::string> known = optionsUsedBy(options.planner);
  if (std::find(known.begin(), known.end(), option) == known.end()) return false;
  return option != "landmarks" || options.search.heuristic == Heuristic::LANDMARK;
}

}  // namespace

std::vector<std::string> unusedOptions(const PlannerOptions& options) {
  const std::vector<std::string> now = linesOf(options.search), usual = linesOf({});
  std::vector<std::string> unused;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const std::string name = now[i].substr(0, now[i].find(':'));
    if (now[i] != usual[i] && !used(name, options)) unused.push_back(name);
  }
  return unused;
}

}  // namespace grid_path_planner
