#include "following/go_to/recovery_steps.h"

#include <sstream>
#include <utility>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::following {

using base::InputError;

namespace {

const std::vector<std::pair<const char*, RecoveryStep>>& knownSteps() {
  static const std::vector<std::pair<const char*, RecoveryStep>> steps = {
      {"wait", RecoveryStep::WAIT},
      {"back_off", RecoveryStep::BACK_OFF},
      {"turn_and_look", RecoveryStep::TURN_AND_LOOK},
      {"plan_with_tolerance", RecoveryStep::PLAN_WITH_TOLERANCE},
      {"clear_scan", RecoveryStep::CLEAR_SCAN}};
  return steps;
}

std::string withoutBlanks(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

RecoveryStep stepNamed(const std::string& name) {
  std::string known;
  for (const auto& [text, step] : knownSteps()) {
    if (name == text) return step;
    known += (known.empty() ? "" : ", ") + std::string(text);
  }
  throw InputError("recovery_steps must be a list of " + known + ", got '" + name + "'");
}

}  // namespace

const char* toString(RecoveryStep step) {
  for (const auto& [text, known] : knownSteps())
    if (known == step) return text;
  return "?";
}

std::vector<RecoveryStep> recoverySteps(const std::string& list) {
  std::vector<RecoveryStep> steps;
  if (withoutBlanks(list).empty()) return steps;
  std::istringstream names(list + ',');  // getline passes over an empty name at the end
  for (std::string name; std::getline(names, name, ',');)
    steps.push_back(stepNamed(withoutBlanks(name)));
  return steps;
}

}  // namespace grid_path_planner::following
