// Options as command lines and study files give them, a line "name: value" for each.
#include "grid_path_planner/base/option_text.h"

#include <sstream>

#include "fuzz/fuzz_target.h"
#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfOptions() {
  return {base::optionText(planning::PlannerOptions()), "radius: 1e3\nkernel: 3\nsmooth: yes\n",
          "tolerance: -0\ntimeout: 1e-320\nheuristic: exact\n"};
}

FUZZ_TARGET(option_text, seedsOfOptions) {
  planning::PlannerOptions options;
  std::istringstream lines(input);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    visitOptions(options, [&](const char* name, auto& value, const base::OptionInfo& info) {
      if (line.compare(0, colon, name) != 0) return;
      mayRefuse([&] { base::parseOption(name, line.substr(colon + 2), info, value); });
    });
  }
  mayRefuse([&] {
    planning::checkPlannerOptions(options);
    planning::PlannerOptions again;
    visitOptions(again, [](const char*, auto&, const base::OptionInfo&) {});
    mustHold(!base::optionText(options).empty(), "options can be written");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
