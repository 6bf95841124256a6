#include "path/straight_runs.h"

#include <cstddef>

namespace grid_path_planner::path {
namespace {

// Steps whose directions differ by less, in radians, lie on one straight line. Above the rounding of
// positions in metres on maps of some kilometres.
constexpr double kSameDirection = 1e-10;

bool sameDirection(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double cross = a.x() * b.y() - a.y() * b.x();
  return a.dot(b) > 0.0 &&
         cross * cross <= kSameDirection * kSameDirection * a.squaredNorm() * b.squaredNorm();
}

}  // namespace

std::vector<Eigen::Vector2d> withoutCollinearPoints(const std::vector<Eigen::Vector2d>& points,
                                                    double longest) {
  std::vector<Eigen::Vector2d> left;
  if (points.empty()) return left;
  left.push_back(points.front());
  Eigen::Vector2d first_step = Eigen::Vector2d::Zero();  // of the segment that grows
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d step = points[i] - points[i - 1];
    const bool goes_on = i > 1 && sameDirection(first_step, step) &&
                         (points[i] - left.back()).squaredNorm() <= longest * longest;
    if (goes_on) continue;
    if (i > 1) left.push_back(points[i - 1]);
    first_step = step;
  }
  if (points.size() > 1) left.push_back(points.back());
  return left;
}

}  // namespace grid_path_planner::path
