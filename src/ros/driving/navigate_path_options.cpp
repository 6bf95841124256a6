#include "ros/driving/navigate_path_options.h"

#include "grid_path_planner/base/options.h"
#include "path/footprint/footprint.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::checkOptionLimits;
using base::InputError;
using following::checkFollowerOptions;

void checkNavigatePathOptions(const NavigatePathOptions& options) {
  checkOptionLimits(options);
  checkFollowerOptions(options.follower);
  checkNetworkText("map_frame", options.map_frame);
  checkNetworkText("base_frame", options.base_frame);
  path::Footprint::fromText("check_footprint", options.check_footprint);
  if (options.limits.thresholds.free_max >= options.limits.thresholds.occupied_min)
    throw InputError("free_max must be below occupied_min, got " +
                     std::to_string(options.limits.thresholds.free_max) + " and " +
                     std::to_string(options.limits.thresholds.occupied_min) + " %");
  if (options.map_frame.empty()) throw InputError("map_frame must not be empty");
  if (options.base_frame.empty()) throw InputError("base_frame must not be empty");
}

}  // namespace grid_path_planner::nodes
