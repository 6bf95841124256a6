#include "grid_path_planner/simulation/depth_camera_options.h"

#include <string>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"

namespace grid_path_planner::simulation {

using base::checkOptionLimits;
using base::decimalText;
using base::InputError;

namespace {

constexpr int kMostPixels = 1 << 22;  // some 100 MB of rays and points, and seconds for a picture

}  // namespace

void checkDepthCameraOptions(const DepthCameraOptions& options) {
  checkOptionLimits(options);
  if (options.width * options.height > kMostPixels)
    throw InputError("width times height must be at most " + std::to_string(kMostPixels) +
                     " pixels, got " + std::to_string(options.width) + " and " +
                     std::to_string(options.height));
  if (options.range_min >= options.range_max)
    throw InputError("range_min must be below range_max, got " + decimalText(options.range_min) +
                     " m and " + decimalText(options.range_max) + " m");
}

}  // namespace grid_path_planner::simulation
