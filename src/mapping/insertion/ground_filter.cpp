#include "mapping/insertion/ground_filter.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

namespace grid_path_planner::mapping {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Plane = Eigen::Hyperplane<double, 3>;

constexpr std::size_t kFewestPoints = 50;
constexpr int kTrials = 200;
constexpr std::size_t kSampleSize = 5000;  // points that count inliers of a trial, evenly chosen

bool isGround(const Plane& plane, const GroundFilterOptions& options) {
  return std::abs(plane.normal().z()) >= std::cos(options.angle) &&
         plane.absDistance(Eigen::Vector3d::Zero()) <= options.plane_distance;
}

std::optional<Plane> planeThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double length = normal.norm();
  if (length < 1e-9) return std::nullopt;  // on one line
  return Plane(normal / length, a);
}

Points evenly(const Points& points, std::size_t most) {
  Points chosen;
  const std::size_t stride = (points.size() + most - 1) / most;
  for (std::size_t i = 0; i < points.size(); i += stride) chosen.push_back(points[i]);
  return chosen;
}

std::ptrdiff_t pointsOn(const Plane& plane, const Points& points, double distance) {
  return std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    return plane.absDistance(point) <= distance;
  });
}

std::optional<Plane> bestPlane(const Points& sample, const GroundFilterOptions& options) {
  std::mt19937 random(1);  // the same draws for every scan
  const auto draw = [&] { return sample[random() % sample.size()]; };
  std::optional<Plane> best;
  std::ptrdiff_t most = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d a = draw(), b = draw(), c = draw();
    const std::optional<Plane> plane = planeThrough(a, b, c);
    if (!plane || !isGround(*plane, options)) continue;
    const std::ptrdiff_t count = pointsOn(*plane, sample, options.distance);
    if (count > most) {
      most = count;
      best = plane;
    }
  }
  return static_cast<std::size_t>(most) >= sample.size() / 20 ? best : std::nullopt;
}

// The plane of least squares through the points that lie on `plane`.
Plane refined(const Plane& plane, const Points& points, double distance) {
  Points on_plane;
  for (const Eigen::Vector3d& point : points)
    if (plane.absDistance(point) <= distance) on_plane.push_back(point);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : on_plane)
    mean += point / static_cast<double>(on_plane.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : on_plane)
    scatter += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  return Plane(solver.eigenvectors().col(0), mean);
}

std::vector<bool> pointsNear(const Plane& plane, const Points& points, double distance) {
  std::vector<bool> near(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    near[i] = plane.absDistance(points[i]) <= distance;
  return near;
}

}  // namespace

GroundSplit splitGround(const Points& points, const GroundFilterOptions& options) {
  GroundSplit split;
  if (points.size() < kFewestPoints) {
    split.is_ground.assign(points.size(), false);
    return split;
  }
  const Points sample = evenly(points, kSampleSize);
  const std::optional<Plane> found = bestPlane(sample, options);
  split.plane_found = found.has_value();
  split.is_ground =
      found ? pointsNear(refined(*found, sample, options.distance), points, options.distance)
            : pointsNear(Plane(Eigen::Vector3d::UnitZ(), 0.0), points, options.plane_distance);
  return split;
}

}  // namespace grid_path_planner::mapping
