// The parameters of the node `vehicle_localizer`.
#pragma once

#include <string>

#include "localization/localizer_options.h"

namespace grid_path_planner::nodes {

struct VehicleLocalizerOptions {
  localization::LocalizerOptions localizer;
  bool use_heading = false;
  double heading_deviation = 0.05;        // rad
  double default_dvl_deviation = 0.0;     // m/s
  double default_depth_deviation = 0.0;   // m
  double default_usbl_deviation = 0.0;    // m
  double default_marker_deviation = 0.0;  // m
  double default_marker_angle = 0.0;      // deg
  double set_pose_deviation = 0.5;        // m
  double set_pose_angle = 5.0;            // deg
  bool use_pressure = false;
  double surface_z = 0.0;             // m
  double water_density = 1025.0;      // kg/m^3
  double pressure_deviation = 200.0;  // Pa
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  std::string usbl_frame = "usbl_link";
  std::string depth_frame = "pressure_link";
  bool publish_map_to_odom = true;
  bool publish_odom_to_base = true;
  double publish_rate = 50.0;  // Hz
};

template <class Visitor>
void visitOptions(VehicleLocalizerOptions& o, Visitor&& visit) {
  using base::OptionInfo;
  visitOptions(o.localizer, visit);
  visit("use_heading", o.use_heading,
        OptionInfo{"Whether the heading of the IMU's orientation is used all the time, as of a "
                   "gyrocompass; false: at the start only, since that of a plain IMU drifts",
                   ""}
            .under("What sensors measure"));
  visit("heading_deviation", o.heading_deviation,
        OptionInfo{"Standard deviation of that heading", "rad", 0.0001, 3.2});
  visit("default_dvl_deviation", o.default_dvl_deviation,
        OptionInfo{"Taken where a message has no variance (all 0, or the first -1); 0: such "
                   "messages are refused",
                   "m/s", 0.0, 100.0});
  visit("default_depth_deviation", o.default_depth_deviation,
        OptionInfo{"The same for depth", "m", 0.0, 1000.0});
  visit("default_usbl_deviation", o.default_usbl_deviation,
        OptionInfo{"The same for usbl/pose", "m", 0.0, 1000.0});
  visit("default_marker_deviation", o.default_marker_deviation,
        OptionInfo{"The same for the position of marker_pose", "m", 0.0, 1000.0});
  visit("default_marker_angle", o.default_marker_angle,
        OptionInfo{"The same for its orientation; both or none", "deg", 0.0, 180.0});
  visit("set_pose_deviation", o.set_pose_deviation,
        OptionInfo{"Of a pose that is set, where it gives no variance: rviz gives none for z", "m",
                   0.001, 1000.0});
  visit("set_pose_angle", o.set_pose_angle, OptionInfo{"The same for angles", "deg", 0.01, 180.0});
  visit("use_pressure", o.use_pressure,
        OptionInfo{"Whether depth is computed from pressure, in the frame of its messages, "
                   "instead of taken from depth",
                   ""});
  visit("surface_z", o.surface_z,
        OptionInfo{"Where the surface is, for use_pressure: there the pressure is 101325 Pa", "m",
                   -10000.0, 10000.0});
  visit("water_density", o.water_density, OptionInfo{"For use_pressure", "kg/m^3", 900.0, 1300.0});
  visit("pressure_deviation", o.pressure_deviation,
        OptionInfo{"For use_pressure, where a message has no variance", "Pa", 0.001, 1e6});
  visit("map_frame", o.map_frame,
        OptionInfo{"Frame of fixes and of odometry/filtered; its z points up", ""}.under("Frames"));
  visit("odom_frame", o.odom_frame, OptionInfo{"Frame of odometry/local", ""});
  visit("base_frame", o.base_frame, OptionInfo{"Frame of the vehicle", ""});
  visit("usbl_frame", o.usbl_frame,
        OptionInfo{"Frame of the place whose position usbl/pose gives", ""});
  visit("depth_frame", o.depth_frame, OptionInfo{"Frame of the place whose z depth gives", ""});
  visit("publish_map_to_odom", o.publish_map_to_odom,
        OptionInfo{"Whether tf map -> odom is published", ""}.under("What is published"));
  visit(
      "publish_odom_to_base", o.publish_odom_to_base,
      OptionInfo{"Whether tf odom -> base_link is published; false where the vehicle does so", ""});
  visit("publish_rate", o.publish_rate,
        OptionInfo{"How often poses are published at most, in time of their stamps", "Hz", 1.0,
                   1000.0});
}

// Throws InputError naming the option for a value outside its limits, and frames that are empty, no
// names, or the same.
void checkVehicleLocalizerOptions(const VehicleLocalizerOptions& options);

}  // namespace grid_path_planner::nodes
