#include "grid_path_planner/base/option_text.h"

#include <algorithm>
#include <exception>

namespace grid_path_planner::base {

double numberFromText(const std::string& name, const std::string& text) {
  std::size_t used = 0;
  double value = NAN;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(value))
    throw InputError(name + " needs a finite number, got '" + text + "'");
  return value;
}

bool truthFromText(const std::string& name, const std::string& text) {
  if (text == "true" || text == "1" || text == "yes") return true;
  if (text == "false" || text == "0" || text == "no") return false;
  throw InputError(name + " needs true or false, got '" + text + "'");
}

std::string configName(std::string name) {
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

}  // namespace grid_path_planner::base
