// The options of all navigation sensors of a simulated vehicle.
#pragma once

#include <string>

#include "grid_path_planner/base/options.h"
#include "simulation/sensors/dvl_options.h"
#include "simulation/sensors/imu_options.h"
#include "simulation/sensors/laser_options.h"
#include "simulation/sensors/pressure_options.h"
#include "simulation/sensors/usbl_options.h"

namespace grid_path_planner::simulation {

struct NavigationSensorOptions {
  ImuOptions imu;
  DvlOptions dvl;
  PressureOptions pressure;
  UsblOptions usbl;
  LaserOptions laser;
};

template <class Visitor>
void visitOptions(NavigationSensorOptions& o, Visitor&& visit) {
  const auto visitAs = [&visit](const std::string& prefix, auto& options) {
    visitOptions(options, [&](const char* name, auto& value, const base::OptionInfo& info) {
      visit((prefix + name).c_str(), value, info);
    });
  };
  visitAs("imu_", o.imu);
  visitAs("dvl_", o.dvl);
  visitAs("pressure_", o.pressure);
  visitAs("usbl_", o.usbl);
  visitAs("laser_", o.laser);
}

// Throws InputError naming the option for a value outside its limits, for a range_min of DVL or laser
// above its range_max, outliers whose least distance is above the largest, and for a sensor that is enabled
// and whose rate is above one in `time_step` seconds.
void checkNavigationSensorOptions(const NavigationSensorOptions& options, double time_step);

}  // namespace grid_path_planner::simulation
