#include <cmath>

#include "fuzz/fuzz_target.h"
#include "vehicle/description.h"
#include "vehicle/motion_model.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfVehicleFile() {
  return {
      "vehicle:\n  drive: differential\n  outline: [[0.04, 0.09], [-0.1, 0.09], [-0.1, -0.09], "
      "[0.04, -0.09]]\n  max_speed: 0.22\n  max_backward_speed: 0.1\n  max_yaw_rate: 1.5\n"
      "  max_acceleration: 1.0\n  max_yaw_acceleration: 3.0\n  drift: 0.01\n",
      "vehicle: {drive: car, radius: 0.3, max_speed: 1, max_yaw_rate: 2, max_acceleration: 1e0, "
      "max_yaw_acceleration: 4, least_turning_radius: 0.7, dead_time: 0, time_constant: 0}\n"};
}

// Whatever was read has an outline, and moves to places that are finite.
FUZZ_TARGET(vehicle_file, seedsOfVehicleFile) {
  mayRefuse([&] {
    const vehicle::Description read = vehicle::readDescription(fileOf("fuzz.yaml", input));
    mustHold(outlineOf(read).inscribedRadius() > 0.0, "an outline has an inside");
    const vehicle::PlanarState moved =
        vehicle::MotionModel(read).advanced({}, {1.0, 1.0, 1.0, 1.0}, 0.1);
    mustHold(moved.position.allFinite() && std::isfinite(moved.yaw), "a place is finite");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
