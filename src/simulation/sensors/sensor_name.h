// The sensors of a simulated vehicle by name; the camera is that of images.
#pragma once

#include <utility>
#include <vector>

namespace grid_path_planner::simulation {

enum class SensorName { IMU, DVL, PRESSURE, USBL, CAMERA };

const std::vector<std::pair<const char*, SensorName>>& choicesOf(SensorName);

}  // namespace grid_path_planner::simulation
