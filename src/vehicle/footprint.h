// The outline of a vehicle that is not round: a simple polygon about its origin, base_link.
//
//   const Footprint footprint = Footprint::fromText("footprint", "[[0.5, 0.3], [-0.5, 0.3], [-0.5, -0.3], [0.5, -0.3]]");
//   search(footprint.inscribedRadius());
//
// The text is that of costmap_2d's parameter `footprint`. Guaranteed: the origin lies inside, no edge
// touches another but the next one at their corner, and both radii are exact up to rounding: the disc of the
// inscribed one lies in the polygon, the polygon in that of the circumscribed one, and no larger and no smaller
// disc about the origin does.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace grid_path_planner::vehicle {

class Footprint {
 public:
  static constexpr double kLargest = 1000.0;  // m, of a coordinate
  static constexpr std::size_t kMostCorners = 1000;

  // None: the vehicle is round.
  Footprint() = default;
  // Corners in metres, base_link, in either direction. Throws InputError that begins with `name` for fewer than
  // three or more than kMostCorners, for coordinates that are no numbers up to kLargest, for edges without a
  // length or that touch others, and for an origin that is not inside.
  Footprint(const std::string& name, std::vector<Eigen::Vector2d> corners);
  // "[[x, y], [x, y], ...]"; "" and "[]": none. Throws InputError as above, and for any other text.
  static Footprint fromText(const std::string& name, const std::string& text);

  bool empty() const { return corners_.empty(); }
  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }
  double inscribedRadius() const { return inscribed_; }          // m
  double circumscribedRadius() const { return circumscribed_; }  // m

 private:
  std::vector<Eigen::Vector2d> corners_;
  double inscribed_ = 0.0;
  double circumscribed_ = 0.0;
};

}  // namespace grid_path_planner::vehicle
