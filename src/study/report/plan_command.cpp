#include <algorithm>

#include "base/shell_text.h"
#include "grid_path_planner/base/option_text.h"
#include "study/report/report.h"
#include "study/study_planners.h"

namespace grid_path_planner::study {

using base::describeOptions, base::differingOptions, base::OptionDescription, base::shellWord;
using grid::Cell;
using planning::PlannerOptions;

namespace {

// --name value for every option that is not as by default.
std::string optionArguments(PlannerOptions options) {
  const std::vector<std::string> changed = differingOptions(PlannerOptions(), options);
  std::string arguments;
  for (const OptionDescription& option : describeOptions(options)) {
    if (std::find(changed.begin(), changed.end(), option.name) == changed.end()) continue;
    std::string flag = option.name;
    std::replace(flag.begin(), flag.end(), '_', '-');
    arguments += " --" + flag + ' ' + shellWord(option.value);
  }
  return arguments;
}

std::string cellArgument(Cell cell) {
  return std::to_string(cell.column) + ',' + std::to_string(cell.row);
}

}  // namespace

std::string planCommand(const StudyData& data, const StudyRun& run) {
  const StudySetting& setting = data.settingOf(run);
  const StudyVariant& variant = data.study().variants[run.variant];
  if (inStudiesOnly(variant.planner) || setting.border != Border::FILLED) return "";
  PlannerOptions options = data.study().base;
  options.costmap = setting.costmap;
  options.planner = variant.planner;
  options.search = variant.search;
  options.retry_finer = false;
  return "rosrun grid_path_planner grid_path plan --map " +
         shellWord(data.study().maps[setting.map].file) + " --cells --start " +
         cellArgument(run.start) + " --goal " + cellArgument(run.goal) + optionArguments(options);
}

}  // namespace grid_path_planner::study
