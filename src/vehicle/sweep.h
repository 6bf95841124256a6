// Whether a vehicle's footprint meets obstacles of a map while it moves, between poses too.
//
//   const FootprintSweep sweep(footprint, geometry, obstacles);
//   if (const auto contact = sweep.first(motion, stop)) report(contact->cell, contact->position, contact->yaw);
//
// Guaranteed: a cell whose interior the footprint enters anywhere on a motion, deeper than a ten-millionth of its
// size (32-bit resolutions are rounded so), is found. Touching a cell's edge is none. Not guaranteed: that the
// footprint enters each cell that is found; it comes within a twentieth of a cell's side. Straight motions are
// exact: a polygon that is shifted covers itself and the parallelograms of its edges. While it turns, each edge
// moves in steps within the hull of where it was and is, grown by how far arcs leave their chords.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "grid/polygon_cover.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/grid/grid_geometry.h"
#include "vehicle/footprint.h"
#include "vehicle/motion.h"

namespace grid_path_planner::vehicle {

struct FootprintObstacles {
  // The first column of a span in the map that is an obstacle; the span's end where none is.
  std::function<int(const grid::RowSpan&)> first;
  bool outside = false;  // whether what lies outside the map is one
};

// Where the vehicle stands when it meets a cell.
struct FootprintContact {
  Eigen::Vector2d position;  // m, of its origin
  double yaw = 0.0;
  grid::Cell cell;       // that it meets: perhaps beside the map
  std::size_t pose = 0;  // of the path, at which the motion begins
  bool on_the_spot = false;
};

class FootprintSweep {
 public:
  // Precondition: the footprint is not empty.
  FootprintSweep(const Footprint& footprint, const grid::GridGeometry& geometry,
                 FootprintObstacles obstacles);

  // The cell that the vehicle meets where it stands, in metres.
  std::optional<grid::Cell> standing(const Eigen::Vector2d& position, double yaw) const;
  // The first contact of a motion. Throws Stopped.
  std::optional<FootprintContact> first(const Motion& motion, const base::StopToken& stop) const;
  // One for each stretch of a footprint's size in which there are any. Throws Stopped.
  std::vector<FootprintContact> all(const Motion& motion, const base::StopToken& stop) const;

 private:
  using Points = std::vector<Eigen::Vector2d>;
  struct Step;

  int stepsOf(const Motion& motion) const;
  Points placed(const Eigen::Vector2d& position, double yaw) const;
  std::optional<grid::Cell> meets(const Points& polygon) const;
  std::optional<grid::Cell> meets(const Step& step) const;
  std::optional<grid::Cell> firstOf(const grid::RowSpan& span) const;
  bool clear(const Points& points, double margin) const;
  template <class Found>
  void visit(const Motion& motion, const base::StopToken& stop, Found&& found) const;

  grid::GridGeometry geometry_;
  FootprintObstacles obstacles_;
  Points points_;  // corners, and the feet of the origin's perpendiculars between them; in cells
  double reach_ = 0.0;  // cells, of the farthest corner
};

}  // namespace grid_path_planner::vehicle
