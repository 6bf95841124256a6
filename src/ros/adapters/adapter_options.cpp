#include "ros/adapters/adapter_options.h"

#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::nodes {

using base::decimalText;
using base::InputError;

namespace {

constexpr double kLeastPoseSpacing = 0.001;  // m

}  // namespace

void checkAdapterOptions(const AdapterOptions& options) {
  planning::checkCostPlannerOptions(options.planner);
  if (options.pose_spacing > 0.0 && options.pose_spacing < kLeastPoseSpacing)
    throw InputError("pose_spacing must be -1, 0, or at least " + decimalText(kLeastPoseSpacing) +
                     " m, got " + decimalText(options.pose_spacing));
}

}  // namespace grid_path_planner::nodes
