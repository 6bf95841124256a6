#include "avoidance/search/directions.h"

#include <algorithm>

namespace grid_path_planner::avoidance {

Directions::Directions(double width, bool elevation) {
  const int half = std::max(1, static_cast<int>(std::lround(180.0 / width)));
  width_ = 180.0 / half;
  columns_ = 2 * half;
  rows_ = elevation ? half / 2 * 2 + 1 : 1;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const Angles angles{column * width_ - 180.0, (row - rows_ / 2) * width_};
      const double azimuth = angles.azimuth * kDegree, height = angles.elevation * kDegree;
      angles_.push_back(angles);
      units_.emplace_back(std::cos(height) * std::cos(azimuth),
                          std::cos(height) * std::sin(azimuth), std::sin(height));
    }
}

int Directions::binOf(const Eigen::Vector3d& direction) const {
  const Angles angles = anglesOf(direction);
  const int column = static_cast<int>(std::lround((angles.azimuth + 180.0) / width_)) % columns_;
  const int row = static_cast<int>(std::lround(angles.elevation / width_)) + rows_ / 2;
  return std::clamp(row, 0, rows_ - 1) * columns_ + column;
}

}  // namespace grid_path_planner::avoidance
