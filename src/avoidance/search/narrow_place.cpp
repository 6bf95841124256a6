#include "avoidance/search/narrow_place.h"

#include <cmath>
#include <limits>

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;

constexpr double kEvery = 0.1;     // m along the path
constexpr double kOpposite = 0.7;  // cosine, of what lies on the other side
constexpr double kWidest = 2.0;    // times the distance that is kept

// Between the nearest point and the nearest on the other side.
std::optional<double> widthAt(const OpenSpace& space, const Vector3d& at, double distance) {
  const double reach = kWidest * distance;
  const auto nearestOf = [&](const auto& counts) {
    Vector3d nearest = Vector3d::Zero();
    double least = reach;
    space.forPoints(at, at, reach, [&](const Eigen::Vector3f& point) {
      const Vector3d away = point.cast<double>() - at;
      if (away.norm() >= least || !counts(away)) return;
      least = away.norm();
      nearest = away;
    });
    return nearest;
  };
  const Vector3d one = nearestOf([](const Vector3d&) { return true; });
  if (one.norm() < 1e-6 || one.norm() >= distance) return std::nullopt;
  const Vector3d side = one.normalized();
  const Vector3d other =
      nearestOf([&](const Vector3d& away) { return away.dot(side) < -kOpposite * away.norm(); });
  if (other.norm() < 1e-6) return std::nullopt;
  const double width = (one - other).dot(side);
  return width < 2.0 * distance ? std::optional(width) : std::nullopt;
}

}  // namespace

std::optional<NarrowPlace> narrowestPlace(const OpenSpace& space, const Points& path,
                                          double distance) {
  NarrowPlace narrowest{Vector3d::Zero(), std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vector3d edge = path[i + 1] - path[i];
    const int samples = 1 + static_cast<int>(edge.norm() / kEvery);
    for (int k = 0; k < samples; ++k) {
      const Vector3d at = path[i] + edge * (static_cast<double>(k) / samples);
      const auto width = widthAt(space, at, distance);
      if (width && *width < narrowest.width) narrowest = {at, *width};
    }
  }
  return std::isfinite(narrowest.width) ? std::optional(narrowest) : std::nullopt;
}

}  // namespace grid_path_planner::avoidance
