// The parameters of the node `simulator`.
#pragma once

#include <string>

#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/simulation/dead_reckoning.h"
#include "grid_path_planner/simulation/depth_camera_options.h"
#include "grid_path_planner/simulation/vehicle_options.h"
#include "ros/simulation/sensor_frames.h"
#include "simulation/camera/image_camera_options.h"
#include "simulation/sensors/navigation_sensor_options.h"
#include "vehicle/description.h"

namespace grid_path_planner::nodes {

// At the bow, looking ahead and down.
inline simulation::DepthCameraOptions vehicleCamera() {
  simulation::DepthCameraOptions camera;
  camera.x = 0.35;
  camera.z = -0.1;
  camera.pitch = 0.6;
  return camera;
}

// At the bow, looking ahead.
inline simulation::ImageCameraOptions vehicleImageCamera() {
  simulation::ImageCameraOptions camera;
  camera.mounting.x = 0.35;
  return camera;
}

struct InitialPose {
  double x = 0.0;    // m, map frame
  double y = 0.0;    // m
  double z = 0.0;    // m
  double yaw = 0.0;  // rad
};

template <class Visitor>
void visitOptions(InitialPose& o, Visitor&& visit) {
  visit("initial_x", o.x,
        base::OptionInfo{"Where the vehicle starts, in map_frame", "m", -1e6, 1e6}.under(
            "Where it starts; a change puts it there, with contacts at 0"));
  visit("initial_y", o.y,
        base::OptionInfo{"Where the vehicle starts, in map_frame", "m", -1e6, 1e6});
  visit("initial_z", o.z, base::OptionInfo{"Where the vehicle starts, upwards", "m", -1e6, 1e6});
  visit("initial_yaw", o.yaw,
        base::OptionInfo{"Where the vehicle looks at the start, anticlockwise from x", "rad", -7.0,
                         7.0});
}

struct SimulatorOptions {
  std::string world;  // SDF file
  simulation::VehicleOptions vehicle;
  simulation::DeadReckoningOptions odometry;
  simulation::DepthCameraOptions camera = vehicleCamera();

  InitialPose initial;

  double real_time_factor = 1.0;
  double update_rate = 100.0;  // Hz, wall time
  bool publish_clock = true;
  double start_time = 1.0;  // s

  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  bool publish_map_to_odom = true;
  bool publish_odom_to_base = true;
  std::string camera_frame = "camera_link";
  std::string camera_optical_frame = "camera_optical_frame";
  SensorFrameNames sensor_frames;

  simulation::NavigationSensorOptions sensors;
  std::string sensor_faults;  // YAML file
  simulation::ImageCameraOptions image_camera = vehicleImageCamera();

  base::ReadOptions reading;
};

template <class Visitor>
void visitOptions(SimulatorOptions& o, Visitor&& visit) {
  visit(
      "world", o.world,
      base::OptionInfo{
          "SDF file below the folder to load from that is seen and touched; empty: only the map's "
          "obstacles; read at the start",
          ""});
  visitOptions(o.vehicle, visit);
  visitOptions(o.initial, visit);
  visit("real_time_factor", o.real_time_factor,
        base::OptionInfo{
            "Simulated seconds in a second of the wall clock; above 1: time-lapse; other "
            "than 1 needs publish_clock",
            "", 0.01, 100.0}
            .under("Time"));
  visit("update_rate", o.update_rate,
        base::OptionInfo{"How often odometry, tf and /clock are published, by the wall clock", "Hz",
                         1.0, 1000.0});
  visit("publish_clock", o.publish_clock,
        base::OptionInfo{
            "Whether /clock is published; the other nodes then need use_sim_time; false: "
            "another clock rules; read at the start",
            ""});
  visit("start_time", o.start_time,
        base::OptionInfo{"What /clock begins with; read at the start", "s", 0.001, 2e9});
  visit("map_frame", o.map_frame,
        base::OptionInfo{"Frame of the map, where obstacles are", ""}.under("Frames"));
  visit("odom_frame", o.odom_frame, base::OptionInfo{"Frame of the odometry", ""});
  visit("base_frame", o.base_frame,
        base::OptionInfo{"Frame of the vehicle, in which it is commanded", ""});
  visit(
      "publish_map_to_odom", o.publish_map_to_odom,
      base::OptionInfo{
          "Whether tf map to odom (the identity) is published; false: a localisation does it", ""});
  visit("publish_odom_to_base", o.publish_odom_to_base,
        base::OptionInfo{"Whether tf odom to base_link is published; false: a localisation does it",
                         ""});
  visit("camera_frame", o.camera_frame, base::OptionInfo{"Frame of the camera: x ahead, z up", ""});
  visit("camera_optical_frame", o.camera_optical_frame,
        base::OptionInfo{"Frame of the camera's points: z ahead, y down", ""});
  visitOptions(o.sensor_frames, visit);
  visitOptions(o.odometry, visit);
  visitOptions(o.camera, [&](const char* name, auto& value, const base::OptionInfo& info) {
    visit((std::string("camera_") + name).c_str(), value, info);
  });
  visitOptions(o.sensors, visit);
  visit(
      "sensor_faults", o.sensor_faults,
      base::OptionInfo{"YAML file below the folder to load from of what is cut and spoiled of the "
                       "sensors' measurements, and when; empty: nothing; read at the start",
                       ""}
          .under("Faults of the navigation sensors"));
  visitOptions(o.image_camera, [&](const char* name, auto& value, const base::OptionInfo& info) {
    visit((std::string("image_camera_") + name).c_str(), value, info);
  });
  visitOptions(o.reading, visit);
}

// Sets outline, limits, response and, of a vehicle that stays on its plane, its height. Throws InputError naming an option that
// is neither its default nor what the description says.
void takeFromVehicle(SimulatorOptions& options, const vehicle::Description& described);

// Throws InputError naming the option for a value outside its limits, a range of the camera that
// holds nothing, a factor other than 1 without a clock, navigation sensors that cannot be, an image
// camera without a world, and frames that are empty or the same.
void checkSimulatorOptions(const SimulatorOptions& options);

}  // namespace grid_path_planner::nodes
