#include "ros/simulation/simulator_options.h"

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"

#include <set>
#include <string>

#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::checkOptionLimits;
using base::decimalText;
using base::InputError;
using simulation::checkDepthCameraOptions;
using simulation::checkVehicleOptions;

namespace {

void checkFrames(const SimulatorOptions& o) {
  std::set<std::string> names;
  for (const std::string& name :
       {o.map_frame, o.odom_frame, o.base_frame, o.camera_frame, o.camera_optical_frame,
        o.sensor_frames.imu, o.sensor_frames.dvl, o.sensor_frames.dvl_altitude,
        o.sensor_frames.pressure, o.sensor_frames.usbl, o.sensor_frames.image_camera}) {
    checkNetworkText("the name of a frame", name);
    if (name.empty()) throw InputError("the name of a frame must not be empty");
    if (!names.insert(name).second)
      throw InputError("frames must have different names, two are called " + name);
  }
}

}  // namespace

void checkSimulatorOptions(const SimulatorOptions& o) {
  checkOptionLimits(o);
  checkVehicleOptions(o.vehicle);
  checkDepthCameraOptions(o.camera);
  checkNavigationSensorOptions(o.sensors, o.vehicle.time_step);
  if (!o.publish_clock && o.real_time_factor != 1.0)
    throw InputError("real_time_factor other than 1 needs publish_clock, got " +
                     decimalText(o.real_time_factor));
  if (o.image_camera.enabled && o.world.empty())
    throw InputError("image_camera_enabled needs a world: without one there is nothing to see");
  checkFrames(o);
}

}  // namespace grid_path_planner::nodes
