#include "ros/avoidance/local_planner_options.h"

#include "ros/common/network_text.h"

namespace grid_path_planner::nodes {

void checkLocalPlannerOptions(const LocalPlannerOptions& options) {
  base::checkOptionLimits(options);
  avoidance::checkPilotOptions(options.pilot);
  checkNetworkText("map_frame", options.map_frame);
  checkNetworkText("base_frame", options.base_frame);
  if (options.map_frame.empty() || options.base_frame.empty())
    throw base::InputError("map_frame and base_frame must not be empty");
}

}  // namespace grid_path_planner::nodes
