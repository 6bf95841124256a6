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
using vehicle::unite;

namespace {

void checkFrames(const SimulatorOptions& o) {
  std::set<std::string> names;
  for (const std::string& name :
       {o.map_frame, o.odom_frame, o.base_frame, o.camera_frame, o.camera_optical_frame,
        o.sensor_frames.imu, o.sensor_frames.dvl, o.sensor_frames.dvl_altitude,
        o.sensor_frames.pressure, o.sensor_frames.usbl, o.sensor_frames.laser,
        o.sensor_frames.image_camera}) {
    checkNetworkText("the name of a frame", name);
    if (name.empty()) throw InputError("the name of a frame must not be empty");
    if (!names.insert(name).second)
      throw InputError("frames must have different names, two are called " + name);
  }
}

}  // namespace

void takeFromVehicle(SimulatorOptions& options, const vehicle::Description& described) {
  simulation::VehicleOptions& o = options.vehicle;
  const SimulatorOptions unset;
  const simulation::VehicleOptions& u = unset.vehicle;
  unite("max_surge_speed", o.max_surge_speed, u.max_surge_speed, described.max_speed);
  unite("max_sway_speed", o.max_sway_speed, u.max_sway_speed, described.max_sideways_speed);
  unite("max_heave_speed", o.max_heave_speed, u.max_heave_speed, described.max_vertical_speed);
  unite("max_yaw_rate", o.max_yaw_rate, u.max_yaw_rate, described.max_yaw_rate);
  unite("max_acceleration", o.max_acceleration, u.max_acceleration, described.max_acceleration);
  unite("max_yaw_acceleration", o.max_yaw_acceleration, u.max_yaw_acceleration,
        described.max_yaw_acceleration);
  unite("least_turning_radius", o.least_turning_radius, u.least_turning_radius,
        described.least_turning_radius);
  unite("response_time", o.response_time, u.response_time, described.time_constant);
  unite("dead_time", o.dead_time, u.dead_time, described.dead_time);
  unite("vehicle_radius", o.vehicle_radius, u.vehicle_radius,
        outlineOf(described).circumscribedRadius());
  uniteOutline("footprint", o.footprint, described);
  if (!described.changesHeight())
    unite("initial_z", options.initial.z, unset.initial.z, described.base_height);
}

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
