#include "vehicle/outline.h"

#include <utility>
#include <vector>

namespace grid_path_planner::vehicle {

namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Where the lines through two edges meet that were shifted outwards by `margin`.
Vector2d shiftedCorner(const Vector2d& before, const Vector2d& corner, const Vector2d& after,
                       double margin) {
  const Vector2d in = (corner - before).normalized(), out = (after - corner).normalized();
  const Vector2d in_normal(in.y(), -in.x()), out_normal(out.y(), -out.x());
  const double scale = 1.0 + in_normal.dot(out_normal);
  return corner + margin * (in_normal + out_normal) / scale;
}

}  // namespace

Outline Outline::grown(double margin) const {
  if (round()) return Outline(radius_ + margin);
  const std::vector<Vector2d>& corners = polygon_.corners();
  const std::size_t count = corners.size();
  std::vector<Vector2d> grown;
  for (std::size_t i = 0; i < count; ++i)
    grown.push_back(shiftedCorner(corners[(i + count - 1) % count], corners[i],
                                  corners[(i + 1) % count], margin));
  return Outline(Footprint("outline", std::move(grown)));
}

Outline Outline::scaled(double factor) const {
  if (round()) return Outline(radius_ * factor);
  std::vector<Vector2d> corners = polygon_.corners();
  for (Vector2d& corner : corners) corner *= factor;
  return Outline(Footprint("outline", std::move(corners)));
}

bool isConvexAnticlockwise(const Footprint& polygon) {
  const std::vector<Vector2d>& corners = polygon.corners();
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d in = corners[(i + 1) % count] - corners[i];
    const Vector2d out = corners[(i + 2) % count] - corners[(i + 1) % count];
    if (cross(in, out) < 0.0) return false;
  }
  return true;
}

}  // namespace grid_path_planner::vehicle
