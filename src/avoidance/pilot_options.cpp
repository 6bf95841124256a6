#include "grid_path_planner/avoidance/pilot_options.h"

#include <string>

#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::avoidance {

using base::checkOptionLimits;
using base::decimalText;
using base::InputError;

namespace {

void checkOrder(const char* low_name, double low, const char* high_name, double high) {
  if (low >= high)
    throw InputError(std::string(low_name) + " must be below " + high_name + ", got " +
                     decimalText(low) + " m and " + decimalText(high) + " m");
}

}  // namespace

const std::vector<std::pair<const char*, Rules>>& choicesOf(Rules) {
  static const std::vector<std::pair<const char*, Rules>> choices = {
      {"published", Rules::PUBLISHED}, {"safe", Rules::SAFE}};
  return choices;
}

const std::vector<std::pair<const char*, Search>>& choicesOf(Search) {
  static const std::vector<std::pair<const char*, Search>> choices = {
      {"direction", Search::DIRECTION}, {"tree", Search::TREE}, {"grid", Search::GRID}};
  return choices;
}

void checkPilotOptions(const PilotOptions& options) {
  checkOptionLimits(options);
  checkOrder("z_min", options.z_min, "z_max", options.z_max);
  if (options.widening > options.d_safe)
    throw InputError("widening must be at most d_safe, got " + decimalText(options.widening) +
                     " m and " + decimalText(options.d_safe) + " m");
  checkOrder("range_min", options.range_min, "range_max", options.range_max);
}

}  // namespace grid_path_planner::avoidance
