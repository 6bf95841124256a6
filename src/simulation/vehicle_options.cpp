#include "grid_path_planner/simulation/vehicle_options.h"

#include <string>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/options.h"

namespace grid_path_planner::simulation {

using base::checkOptionLimits;
using base::decimalText;
using base::InputError;

void checkVehicleOptions(const VehicleOptions& options) {
  checkOptionLimits(options);
  if (options.time_step > options.cmd_vel_timeout)
    throw InputError("time_step must not be longer than cmd_vel_timeout, got " +
                     decimalText(options.time_step) + " s and " +
                     decimalText(options.cmd_vel_timeout) + " s");
}

}  // namespace grid_path_planner::simulation
