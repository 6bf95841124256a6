#include "simulation/closest_point.h"

#include <algorithm>

namespace grid_path_planner::simulation {
namespace {

using Eigen::Vector3d;

Vector3d closestPointOnSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d segment = b - a;
  const double length_squared = segment.squaredNorm();
  if (length_squared == 0.0) return a;
  return a + std::clamp(segment.dot(p - a) / length_squared, 0.0, 1.0) * segment;
}

const Vector3d& nearer(const Vector3d& p, const Vector3d& first, const Vector3d& second) {
  return (second - p).squaredNorm() < (first - p).squaredNorm() ? second : first;
}

}  // namespace

Vector3d closestPointOnTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                                const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a;
  // Barycentric numerators: which side of each edge p's projection lies on.
  const double d1 = ab.dot(p - a), d2 = ac.dot(p - a);
  const double d3 = ab.dot(p - b), d4 = ac.dot(p - b);
  const double d5 = ab.dot(p - c), d6 = ac.dot(p - c);
  const double va = d3 * d6 - d5 * d4;
  const double vb = d5 * d2 - d1 * d6;
  const double vc = d1 * d4 - d3 * d2;
  if (va > 0.0 && vb > 0.0 && vc > 0.0) {
    const double sum = va + vb + vc;
    return a + ab * (vb / sum) + ac * (vc / sum);
  }
  const Vector3d of_ab = closestPointOnSegment(p, a, b);
  const Vector3d of_bc = closestPointOnSegment(p, b, c);
  return nearer(p, nearer(p, of_ab, of_bc), closestPointOnSegment(p, a, c));
}

}  // namespace grid_path_planner::simulation
