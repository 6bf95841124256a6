#include "grid_path_planner/ros/simulator_options.h"

#include "grid_path_planner/base/check_options.h"

namespace grid_path_planner {

void checkSimulatorOptions(const SimulatorOptions& o) {
  checkOptionLimits(o);
  checkVehicleOptions(o.vehicle);
  if (!o.publish_clock && o.real_time_factor != 1.0)
    throw InputError("real_time_factor other than 1 needs publish_clock, got " +
                     std::to_string(o.real_time_factor));
  if (o.map_frame.empty() || o.odom_frame.empty() || o.base_frame.empty())
    throw InputError("map_frame, odom_frame and base_frame must not be empty");
  if (o.map_frame == o.odom_frame || o.odom_frame == o.base_frame || o.map_frame == o.base_frame)
    throw InputError("map_frame, odom_frame and base_frame must be three different frames, got " +
                     o.map_frame + ", " + o.odom_frame + " and " + o.base_frame);
}

}  // namespace grid_path_planner
