#include <algorithm>
#include <cctype>

#include "grid_path_planner/base/option_text.h"
#include "study/report/report.h"
#include "study/study_planners.h"

namespace grid_path_planner::study {

using base::describeOptions, base::differingOptions, base::OptionDescription;
using grid::Cell;
using planning::PlannerOptions;

namespace {

std::string quoted(const std::string& text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](unsigned char letter) {
    return std::isalnum(letter) != 0 || std::string("/._-+,").find(letter) != std::string::npos;
  });
  if (plain && !text.empty()) return text;
  std::string out = "'";
  for (const char letter : text)
    out += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return out + '\'';
}

// --name value for every option that is not as by default.
std::string optionArguments(PlannerOptions options) {
  const std::vector<std::string> changed = differingOptions(PlannerOptions(), options);
  std::string arguments;
  for (const OptionDescription& option : describeOptions(options)) {
    if (std::find(changed.begin(), changed.end(), option.name) == changed.end()) continue;
    std::string flag = option.name;
    std::replace(flag.begin(), flag.end(), '_', '-');
    arguments += " --" + flag + ' ' + quoted(option.value);
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
         quoted(data.study().maps[setting.map].file) + " --cells --start " +
         cellArgument(run.start) + " --goal " + cellArgument(run.goal) + optionArguments(options);
}

}  // namespace grid_path_planner::study
