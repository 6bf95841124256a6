#include "ros/driving/navigate_path_options.h"

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::nodes {

using base::checkOptionLimits;
using base::InputError;
using following::checkFollowerOptions;

void checkNavigatePathOptions(const NavigatePathOptions& options) {
  checkOptionLimits(options);
  checkFollowerOptions(options.follower);
  if (options.base_frame.empty()) throw InputError("base_frame must not be empty");
}

}  // namespace grid_path_planner::nodes
