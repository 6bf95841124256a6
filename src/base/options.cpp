#include "grid_path_planner/base/options.h"

#include <locale>
#include <sstream>

namespace grid_path_planner::base {
namespace {

std::string shortNumber(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(12);
  text << value;
  return text.str();
}

}  // namespace

void checkLimits(const std::string& name, double value, const OptionInfo& info) {
  if (value >= info.minimum && value <= info.maximum) return;  // NaN fails both
  throw InputError(name + " must be a number from " + shortNumber(info.minimum) + " to " +
                   shortNumber(info.maximum) + (*info.unit ? std::string(" ") + info.unit : "") +
                   ", got " + shortNumber(value));
}

}  // namespace grid_path_planner::base
