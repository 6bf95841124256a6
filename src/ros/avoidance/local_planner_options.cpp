#include "ros/avoidance/local_planner_options.h"

#include "grid_path_planner/base/decimal_text.h"
#include "ros/common/network_text.h"

namespace grid_path_planner::nodes {

void checkLocalPlannerOptions(const LocalPlannerOptions& options) {
  base::checkOptionLimits(options);
  avoidance::checkPilotOptions(options.pilot);
  if (options.control_rate * options.pilot.frame_period < 1.0 - 1e-9)
    throw base::InputError(
        "control_rate must be at least 1 / frame_period, since a command holds "
        "for frame_period; got " +
        base::decimalText(options.control_rate) + " Hz and " +
        base::decimalText(options.pilot.frame_period) + " s");
  checkNetworkText("map_frame", options.map_frame);
  checkNetworkText("base_frame", options.base_frame);
  if (options.map_frame.empty() || options.base_frame.empty())
    throw base::InputError("map_frame and base_frame must not be empty");
}

}  // namespace grid_path_planner::nodes
