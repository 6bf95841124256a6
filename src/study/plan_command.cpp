#include <algorithm>
#include <sstream>

#include "grid_path_planner/study/report.h"
#include "grid_path_planner/study/study_planners.h"

namespace grid_path_planner {
namespace {

template <class Value>
std::string shown(const Value& value) {
  std::ostringstream out;
  out.precision(12);
  if constexpr (std::is_enum_v<Value>)
    out << choiceName(value);
  else
    out << std::boolalpha << value;
  return out.str();
}

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
  std::vector<std::string> defaults;
  PlannerOptions standard;
  visitOptions(standard, [&](const char*, auto& value, const OptionInfo&) {
    defaults.push_back(shown(value));
  });
  std::string arguments;
  std::size_t i = 0;
  visitOptions(options, [&](const char* name, auto& value, const OptionInfo&) {
    std::string flag(name);
    std::replace(flag.begin(), flag.end(), '_', '-');
    if (shown(value) != defaults[i++]) arguments += " --" + flag + ' ' + quoted(shown(value));
  });
  return arguments;
}

std::string cellArgument(Cell cell) {
  return std::to_string(cell.column) + ',' + std::to_string(cell.row);
}

}  // namespace

std::string planCommand(const StudyData& data, const StudyRun& run) {
  const StudySetting& setting = data.settingOf(run);
  const StudyVariant& variant = data.study().variants[run.variant];
  if (inStudiesOnly(variant.planner, variant.published_cross)) return "";
  PlannerOptions options = data.study().base;
  options.terrain = setting.terrain;
  options.planner = variant.planner;
  options.search = variant.search;
  options.retry_finer = false;
  return "rosrun grid_path_planner grid_path plan --map " +
         quoted(data.study().maps[setting.map].file) + " --cells --start " +
         cellArgument(run.start) + " --goal " + cellArgument(run.goal) + optionArguments(options);
}

}  // namespace grid_path_planner
