// Numbers and places in the sentences about a flight.
#pragma once

#include <Eigen/Core>
#include <cstdio>
#include <string>

namespace grid_path_planner::avoidance {

// With one decimal.
inline std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f", value);
  return text;
}

inline std::string placeText(const Eigen::Vector3d& place) {
  return "(" + shortNumber(place.x()) + ", " + shortNumber(place.y()) + ", " +
         shortNumber(place.z()) + ")";
}

}  // namespace grid_path_planner::avoidance
