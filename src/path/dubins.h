// The shortest curve for a vehicle that drives forwards only and turns with a least radius: of an arc, a line or arc, and an arc
// (L. E. Dubins, "On curves of minimal length with a constraint on average curvature", 1957; the formulas as in A. M. Shkel
// and V. Lumelsky, "Classification of the Dubins set", 2001).
//
//   const DubinsCurve curve = dubinsCurve({from, direction}, {to, direction}, radius);
//   for (const Eigen::Vector2d& point : curve.points(0.05)) add(point);
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace grid_path_planner::path {

struct DirectedPoint {
  Eigen::Vector2d position;
  double direction = 0.0;  // in which it is passed
};

class DubinsCurve {
 public:
  struct Part {
    int turn = 0;         // 1 left, -1 right, 0 straight
    double length = 0.0;  // of radii: the angle of an arc
  };

  DubinsCurve(const DirectedPoint& from, double radius, const std::array<Part, 3>& parts)
      : from_(from), radius_(radius), parts_(parts) {}

  double length() const;
  // Points on it after its beginning, the end included; those of an arc at most `step` radians apart, of a line only its end.
  std::vector<Eigen::Vector2d> points(double step) const;
  DirectedPoint end() const;

 private:
  DirectedPoint from_;
  double radius_;
  std::array<Part, 3> parts_;
};

// Precondition: the radius is above 0. There always is one.
DubinsCurve dubinsCurve(const DirectedPoint& from, const DirectedPoint& to, double radius);

}  // namespace grid_path_planner::path
