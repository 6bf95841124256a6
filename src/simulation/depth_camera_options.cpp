#include "grid_path_planner/simulation/depth_camera_options.h"

#include <string>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"

namespace grid_path_planner::simulation {

using base::checkOptionLimits;
using base::decimalText;
using base::InputError;

void checkDepthCameraOptions(const DepthCameraOptions& options) {
  checkOptionLimits(options);
  if (options.range_min >= options.range_max)
    throw InputError("range_min must be below range_max, got " + decimalText(options.range_min) +
                     " m and " + decimalText(options.range_max) + " m");
}

}  // namespace grid_path_planner::simulation
