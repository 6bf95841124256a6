// The directions about a vehicle, in bins of azimuth and elevation.
//
// Bin centres are the multiples of the width, 0 among them; elevations run from -90 to 90 degrees.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace grid_path_planner::avoidance {

constexpr double kDegree = M_PI / 180.0;

// Degrees; azimuth anticlockwise from x.
struct Angles {
  double azimuth = 0.0, elevation = 0.0;
};

inline Angles anglesOf(const Eigen::Vector3d& direction) {
  return {std::atan2(direction.y(), direction.x()) / kDegree,
          std::atan2(direction.z(), direction.head<2>().norm()) / kDegree};
}

// Between two azimuths, at most 180 degrees.
inline double turnBetween(double a, double b) {
  const double turn = std::abs(a - b);
  return turn > 180.0 ? std::abs(turn - 360.0 * std::round(turn / 360.0)) : turn;
}

class Directions {
 public:
  // `width` in degrees, made a whole part of 180. Level ones only, unless `elevation`.
  Directions(double width, bool elevation);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int size() const { return columns_ * rows_; }
  const Eigen::Vector3d& unit(int bin) const { return units_[bin]; }
  const Angles& angles(int bin) const { return angles_[bin]; }
  int binOf(const Eigen::Vector3d& direction) const;

 private:
  double width_;
  int columns_, rows_;
  std::vector<Eigen::Vector3d> units_;
  std::vector<Angles> angles_;
};

}  // namespace grid_path_planner::avoidance
