#include "support/footprint_reference.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>

#include "path/pose_spacing.h"

namespace grid_path_planner::test {

using grid::Cell, grid::OccupancyGrid;
using path::HeadingMode, path::Path, path::Pose, path::spacedPoses;

namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point>;
using Corners = std::vector<Eigen::Vector2d>;

double overlapAt(const Corners& corners, const Pose& pose, const OccupancyGrid& map) {
  Polygon polygon;
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const Eigen::Vector2d& p : corners) {
    const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
    const Eigen::Vector2d at = map.geometry().gridFromWorld(
        pose.position.head<2>() + Eigen::Vector2d(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
    bg::append(polygon.outer(), Point(at.x(), at.y()));
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  bg::correct(polygon);
  const auto index = [](double at, int size) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, size - 1.0));
  };
  double largest = 0.0;
  for (int row = index(low.y(), map.height()); row <= index(high.y(), map.height()); ++row)
    for (int column = index(low.x(), map.width()); column <= index(high.x(), map.width());
         ++column) {
      if (map[Cell{column, row}] < 65) continue;
      std::vector<Polygon> shared;
      bg::intersection(
          polygon, bg::model::box<Point>(Point(column, row), Point(column + 1, row + 1)), shared);
      for (const Polygon& part : shared) largest = std::max(largest, bg::area(part));
    }
  return largest;
}

double directionTo(const std::vector<Pose>& poses, std::size_t i) {
  const Eigen::Vector3d along = poses[i].position - poses[i - 1].position;
  return std::atan2(along.y(), along.x());
}

// From this pose on the heading changes while the vehicle drives, not on the spot.
std::size_t turnsWhileDriving(const std::vector<Pose>& poses, HeadingMode mode) {
  if (mode == HeadingMode::INTERPOLATE) return 0;
  if (mode != HeadingMode::FORWARD_THEN_INTERPOLATE) return poses.size();
  std::size_t i = poses.size() - 1;
  while (i > 1 && std::abs(std::remainder(directionTo(poses, i) - directionTo(poses, i - 1),
                                          2.0 * M_PI)) < 1e-6)
    --i;
  return i - 1;
}

}  // namespace

double largestOverlap(const Corners& corners, const Path& path, double start_yaw, HeadingMode mode,
                      double step, const OccupancyGrid& map) {
  constexpr double kTurn = M_PI / 60.0;
  const std::vector<Pose> poses = spacedPoses(path, step, mode).poses;
  const std::size_t driving = turnsWhileDriving(poses, mode);
  double largest = 0.0, yaw = start_yaw;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double turn = std::remainder(poses[i].yaw - yaw, 2.0 * M_PI);
    const int parts = 1 + static_cast<int>(std::abs(turn) / kTurn);
    for (int part = 0; part <= parts; ++part) {
      Pose pose = poses[i];
      pose.yaw = yaw + turn * part / parts;
      if (i > driving)
        pose.position =
            poses[i - 1].position + (poses[i].position - poses[i - 1].position) * part / parts;
      largest = std::max(largest, overlapAt(corners, pose, map));
    }
    yaw = poses[i].yaw;
  }
  return largest;
}

}  // namespace grid_path_planner::test
