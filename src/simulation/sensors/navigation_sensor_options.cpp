#include "simulation/sensors/navigation_sensor_options.h"

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::simulation {

using base::checkOptionLimits, base::decimalText, base::InputError;

namespace {

template <class Options>
void checkRate(const std::string& sensor, const Options& options, double time_step) {
  if (options.enabled && options.rate * time_step > 1.0 + 1e-9)
    throw InputError(sensor + "_rate must be at most one measurement in a time_step, got " +
                     decimalText(options.rate) + " Hz and " + decimalText(time_step) + " s");
}

void checkOrder(const std::string& least, const std::string& largest, double a, double b) {
  if (a > b)
    throw InputError(least + " must not be above " + largest + ", got " + decimalText(a) +
                     " m and " + decimalText(b) + " m");
}

}  // namespace

void checkNavigationSensorOptions(const NavigationSensorOptions& o, double time_step) {
  checkOptionLimits(o);
  checkRate("imu", o.imu, time_step);
  checkRate("dvl", o.dvl, time_step);
  checkRate("pressure", o.pressure, time_step);
  checkRate("usbl", o.usbl, time_step);
  checkRate("laser", o.laser, time_step);
  checkOrder("dvl_range_min", "dvl_range_max", o.dvl.range_min, o.dvl.range_max);
  checkOrder("laser_range_min", "laser_range_max", o.laser.range_min, o.laser.range_max);
  checkOrder("usbl_outlier_min", "usbl_outlier_max", o.usbl.outlier_min, o.usbl.outlier_max);
}

}  // namespace grid_path_planner::simulation
