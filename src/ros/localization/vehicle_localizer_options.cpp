#include "ros/localization/vehicle_localizer_options.h"

#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::InputError;

void checkVehicleLocalizerOptions(const VehicleLocalizerOptions& options) {
  base::checkOptionLimits(options);
  const auto check = [](const char* name, const std::string& frame) {
    checkNetworkText(name, frame);
    if (frame.empty()) throw InputError(std::string(name) + " must not be empty");
  };
  check("map_frame", options.map_frame);
  check("odom_frame", options.odom_frame);
  check("base_frame", options.base_frame);
  check("usbl_frame", options.usbl_frame);
  check("depth_frame", options.depth_frame);
  if (options.map_frame == options.odom_frame || options.odom_frame == options.base_frame ||
      options.map_frame == options.base_frame)
    throw InputError("map_frame, odom_frame and base_frame must be three");
  if ((options.default_marker_deviation > 0.0) != (options.default_marker_angle > 0.0))
    throw InputError("default_marker_deviation and default_marker_angle: both or none");
}

}  // namespace grid_path_planner::nodes
