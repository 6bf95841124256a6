#include "grid_path_planner/mapping/projection_options.h"

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"

namespace grid_path_planner::mapping {

using base::checkOptionLimits;
using base::decimalText;
using base::InputError;

const std::vector<std::pair<const char*, ProjectionReference>>& choicesOf(ProjectionReference) {
  static const std::vector<std::pair<const char*, ProjectionReference>> choices = {
      {"fixed", ProjectionReference::FIXED},
      {"vehicle", ProjectionReference::VEHICLE},
      {"seabed", ProjectionReference::SEABED}};
  return choices;
}

void checkProjectionOptions(const ProjectionOptions& o) {
  checkOptionLimits(o);
  if (!(o.min_z < o.max_z))
    throw InputError("the band of the projection must have a min_z below its max_z, got " +
                     decimalText(o.min_z) + " and " + decimalText(o.max_z));
  const ProjectionBounds& b = o.bounds;
  if (b.given() && !(b.min_x < b.max_x && b.min_y < b.max_y))
    throw InputError("projection_bounds must be a rectangle or all 0, got x from " +
                     decimalText(b.min_x) + " to " + decimalText(b.max_x) + ", y from " +
                     decimalText(b.min_y) + " to " + decimalText(b.max_y));
}

}  // namespace grid_path_planner::mapping
