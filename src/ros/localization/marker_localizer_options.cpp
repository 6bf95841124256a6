#include "ros/localization/marker_localizer_options.h"

#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::InputError;

void checkMarkerLocalizerOptions(const MarkerLocalizerOptions& options) {
  base::checkOptionLimits(options);
  checkNetworkText("map_frame", options.map_frame);
  checkNetworkText("odom_frame", options.odom_frame);
  checkNetworkText("base_frame", options.base_frame);
  if (options.map_frame.empty() || options.base_frame.empty() ||
      options.map_frame == options.base_frame)
    throw InputError("map_frame and base_frame must be two");
  if (options.odom_frame.empty() || options.odom_frame == options.base_frame)
    throw InputError("odom_frame must not be empty, nor base_frame");
  if (options.layout.empty()) throw InputError("layout must name the file of the panel's markers");
}

}  // namespace grid_path_planner::nodes
