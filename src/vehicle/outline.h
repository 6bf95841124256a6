// The outline of a vehicle in the plane: a disc about base_link, or a convex polygon around it.
#pragma once

#include "vehicle/footprint.h"

namespace grid_path_planner::vehicle {

class Outline {
 public:
  // Precondition: the radius is above 0.
  explicit Outline(double radius) : radius_(radius) {}
  // Precondition: the polygon is not empty.
  explicit Outline(Footprint polygon) : polygon_(std::move(polygon)) {}

  bool round() const { return polygon_.empty(); }
  const Footprint& polygon() const { return polygon_; }  // empty: round
  double inscribedRadius() const { return round() ? radius_ : polygon_.inscribedRadius(); }
  double circumscribedRadius() const { return round() ? radius_ : polygon_.circumscribedRadius(); }

  // One that holds every point nearer than `margin` (m, not negative) to this one.
  Outline grown(double margin) const;
  // Precondition: the factor is above 0.
  Outline scaled(double factor) const;

 private:
  double radius_ = 0.0;
  Footprint polygon_;
};

// Whether every corner turns left.
bool isConvexAnticlockwise(const Footprint& polygon);

}  // namespace grid_path_planner::vehicle
