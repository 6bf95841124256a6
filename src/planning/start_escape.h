// The straight lines by which a vehicle may leave a start that is too near to something, or in it.
//
//   const StartEscape escape(costs, kept, start, start_escape_radius, stop);
//   if (escape.leads(costs.geometry().centre(cell))) take(cell);
//
// Guaranteed: no point of such a line is nearer to an occupied cell, an unknown one or the border than the
// start is, where that is nearer than what is kept. From inside a class of cells, it leaves them at a place
// that is no farther from the nearest edge than the start is, and touches none of them again: it goes through
// no wall but by the half in which the start is.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planning {

class StartEscape {
 public:
  // `kept` says what is kept elsewhere; classes that are below 0 there count for nothing. No line is longer than
  // `longest`. `start` and `longest` in metres; `costs`, at full resolution, outlives this. Throws Stopped.
  // Precondition: the start is in the map.
  StartEscape(const costmap::CostGrid& costs, const costmap::KeptDistances& kept,
              const Eigen::Vector2d& start, double longest, const base::StopToken& stop);

  // Whether the line to a point, in metres and in the map, is one of these.
  bool leads(const Eigen::Vector2d& to) const;

  // What such a line does: "comes no nearer than 0.2 m to an occupied cell"; "" where nothing is near.
  std::string text() const;

 private:
  // A class of cells that is kept away from.
  struct Obstacles {
    grid::Occupancy occupancy;
    double least;  // m, from the start; 0: it is in one or touches one
    bool lowered;  // whether `least` is below what is kept elsewhere
    bool left;     // whether the start is in one
  };

  void add(grid::Occupancy occupancy, double kept);
  void findExits(double longest, const base::StopToken& stop);
  bool open(grid::Cell cell) const;
  bool keeps(const Obstacles& from, const Eigen::Vector2d& to) const;
  bool leaves(const Obstacles& obstacles, const Eigen::Vector2d& to) const;
  double exitFrom(const Obstacles& obstacles, const Eigen::Vector2d& along, double length) const;

  const costmap::CostGrid& costs_;
  const Eigen::Vector2d start_;  // m
  const Eigen::Vector2d from_;   // the same in cells
  std::vector<Obstacles> obstacles_;
  double border_ = 0.0;  // m, least distance to the border
  bool border_lowered_ = false;
  // Of a start inside: the nearest points that are in none, in cells, and how far they are.
  std::vector<Eigen::Vector2d> exits_;
  double depth_ = 0.0;
};

}  // namespace grid_path_planner::planning
