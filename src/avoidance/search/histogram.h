// The polar histogram of 3DVFH+: how far the nearest remembered point is in each direction.
//
// A bin holds its nearest point, not the mean, which would move a pole into the wall behind it.
#pragma once

#include <limits>
#include <vector>

#include "avoidance/memory/open_space.h"
#include "avoidance/search/directions.h"

namespace grid_path_planner::avoidance {

class Histogram {
 public:
  // Of the points within `reach` of `origin`.
  void fill(const OpenSpace& space, const Directions& directions, const Eigen::Vector3d& origin,
            double reach) {
    distances_.assign(directions.size(), std::numeric_limits<float>::infinity());
    space.forPoints(origin, origin, reach, [&](const Eigen::Vector3f& point) {
      const Eigen::Vector3d direction = point.cast<double>() - origin;
      const auto distance = static_cast<float>(direction.norm());
      if (distance > reach) return;
      float& nearest = distances_[directions.binOf(direction)];
      nearest = distance < nearest ? distance : nearest;
    });
  }

  // m; infinite where there is nothing.
  float distance(int bin) const { return distances_[bin]; }
  const std::vector<float>& distances() const { return distances_; }

 private:
  std::vector<float> distances_;
};

}  // namespace grid_path_planner::avoidance
