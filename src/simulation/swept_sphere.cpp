#include "simulation/swept_sphere.h"

#include <algorithm>

namespace grid_path_planner::simulation {
namespace {

constexpr double kLeastDepth = 1e-9;  // m; a surface this little inside the sphere does not stop it
constexpr double kCut = 1e-6;         // m; a surface this far inside was there from the beginning
constexpr double kPiece = 1e-3;  // m; along a near surface the motion is checked in such pieces
constexpr int kHalvings = 24;    // of a piece, to find the contact: 1e-10 m

}  // namespace

// The sphere may always move by its clearance (conservative advancement), so most motions take one
// query of the world.
SweptSphere sweptSphere(const World& world, double radius, const Eigen::Vector3d& from,
                        const Eigen::Vector3d& to) {
  const double length = (to - from).norm();
  if (length == 0.0) return {to, std::nullopt};
  const auto place = [&](double distance) -> Eigen::Vector3d {
    return from + (distance / length) * (to - from);
  };
  const auto surfaceNear = [&](const Eigen::Vector3d& centre, double reach) {
    return world.nearest(centre, radius + reach);
  };
  std::optional<NearestSurface> near = surfaceNear(from, length);
  if (near && near->distance < radius - kCut) return {to, std::nullopt};
  double free = 0.0;
  while (near && free + (near->distance - radius) < length) {
    const double next = std::min(length, free + std::max(kPiece, near->distance - radius));
    near = surfaceNear(place(next), length - next);
    if (near && near->distance < radius - kLeastDepth) {
      double closed = next;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (free + closed);
        (surfaceNear(place(middle), 0.0) ? closed : free) = middle;
      }
      return {place(free), near};
    }
    free = next;
  }
  return {to, std::nullopt};
}

}  // namespace grid_path_planner::simulation
