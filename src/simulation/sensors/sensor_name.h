// The navigation sensors by name.
#pragma once

#include <utility>
#include <vector>

namespace grid_path_planner::simulation {

enum class SensorName { IMU, DVL, PRESSURE, USBL };

const std::vector<std::pair<const char*, SensorName>>& choicesOf(SensorName);

}  // namespace grid_path_planner::simulation
