// The names of the frames of a simulated vehicle's navigation sensors.
#pragma once

#include <string>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::nodes {

struct SensorFrameNames {
  std::string imu = "imu_link";
  std::string dvl = "dvl_link";
  std::string dvl_altitude = "dvl_altitude_link";
  std::string pressure = "pressure_link";
  std::string usbl = "usbl_link";
  std::string laser = "laser_link";
  std::string image_camera = "image_camera_optical_frame";
};

template <class Visitor>
void visitOptions(SensorFrameNames& o, Visitor&& visit) {
  visit("imu_frame", o.imu, base::OptionInfo{"Frame of the inertial measurement unit", ""});
  visit("dvl_frame", o.dvl, base::OptionInfo{"Frame of the Doppler velocity log", ""});
  visit("dvl_altitude_frame", o.dvl_altitude,
        base::OptionInfo{"Frame of its altitude: x down", ""});
  visit("pressure_frame", o.pressure, base::OptionInfo{"Frame of the pressure sensor", ""});
  visit("usbl_frame", o.usbl,
        base::OptionInfo{"Frame of the transponder of the acoustic positioning", ""});
  visit("laser_frame", o.laser, base::OptionInfo{"Frame of the laser scanner: x ahead", ""});
  visit("image_camera_frame", o.image_camera,
        base::OptionInfo{"Frame of the image camera: z ahead, y down", ""});
}

}  // namespace grid_path_planner::nodes
