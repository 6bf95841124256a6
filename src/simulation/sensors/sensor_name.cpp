#include "simulation/sensors/sensor_name.h"

namespace grid_path_planner::simulation {

const std::vector<std::pair<const char*, SensorName>>& choicesOf(SensorName) {
  static const std::vector<std::pair<const char*, SensorName>> choices = {
      {"imu", SensorName::IMU},
      {"dvl", SensorName::DVL},
      {"pressure", SensorName::PRESSURE},
      {"usbl", SensorName::USBL},
      {"camera", SensorName::CAMERA}};
  return choices;
}

}  // namespace grid_path_planner::simulation
