// Costs for another try at a path on which a footprint fits: places where it did not fit are closed, and where a vehicle cannot
// turn freely cells cost more, so that paths lead through the middle of narrow places, straight, and turn elsewhere.
//
//   TryCosts raised(costs, start, goal);
//   raised.raise(*inflated_by_the_circumscribed_radius, 32);
//   while (fails && raised.close(path, contacts, radius)) plan(*raised.costs());
#pragma once

#include <memory>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/path/path.h"
#include "vehicle/sweep.h"

namespace grid_path_planner::planning {

class TryCosts {
 public:
  // Of a copy of the costmap, which outlives this. The cells of the two ends stay open; a null one is none.
  TryCosts(const costmap::CostGrid& costs, const Eigen::Vector2d& start,
           const Eigen::Vector2d* goal);

  // Multiplies the weights of cells that are blocked in `turning`, of the same geometry.
  void raise(const costmap::CostGrid& turning, int factor);
  // Closes the cells within `radius` metres of the places of the path where the contacts are; of those near an end
  // within that and two cells more of the path, since the end itself stays. False where all were closed before.
  bool close(const path::Path& path, const std::vector<vehicle::FootprintContact>& contacts,
             double radius);

  std::shared_ptr<const costmap::CostGrid> costs() const;

 private:
  bool closeAround(const Eigen::Vector2d& centre, double radius);

  const costmap::CostGrid& original_;
  std::vector<grid::Cell> ends_;
  grid::Grid<costmap::CostGrid::Weight> weights_;
};

}  // namespace grid_path_planner::planning
