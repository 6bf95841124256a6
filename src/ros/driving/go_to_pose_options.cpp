#include "ros/driving/go_to_pose_options.h"

#include <ros/names.h>

#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::checkOptionLimits;
using base::InputError;
using following::checkNavigatorOptions;

void checkGoToPoseOptions(const GoToPoseOptions& options) {
  checkOptionLimits(options);
  checkNavigatorOptions(options.navigator);
  checkNetworkText("map_frame", options.map_frame);
  checkNetworkText("base_frame", options.base_frame);
  checkNetworkText("action_name", options.action_name);
  if (options.map_frame.empty()) throw InputError("map_frame must not be empty");
  if (options.base_frame.empty()) throw InputError("base_frame must not be empty");
  std::string why;
  if (options.action_name.empty() || !ros::names::validate(options.action_name, why))
    throw InputError("action_name must be a name of ROS, got '" + options.action_name + "'");
}

}  // namespace grid_path_planner::nodes
