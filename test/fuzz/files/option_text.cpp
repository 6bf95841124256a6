// Options as command lines and study files give them, a line "name: value" for each.
#include "grid_path_planner/base/option_text.h"

#include <sstream>
#include <unordered_map>

#include "fuzz/fuzz_target.h"
#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfOptions() {
  return {base::optionText(planning::PlannerOptions()), "radius: 1e3\nkernel: 3\nsmooth: yes\n",
          "tolerance: -0\ntimeout: 1e-320\nheuristic: exact\n"};
}

// The last line of a name counts, so that each option is parsed once.
std::unordered_map<std::string, std::string> linesOf(const std::string& input) {
  std::unordered_map<std::string, std::string> values;
  std::istringstream lines(input);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) values[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return values;
}

FUZZ_TARGET(option_text, seedsOfOptions) {
  const auto values = linesOf(input);
  planning::PlannerOptions options;
  visitOptions(options, [&](const char* name, auto& value, const base::OptionInfo& info) {
    const auto given = values.find(name);
    if (given != values.end())
      mayRefuse([&] { base::parseOption(name, given->second, info, value); });
  });
  mayRefuse([&] {
    planning::checkPlannerOptions(options);
    mustHold(!base::optionText(options).empty(), "options can be written");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
