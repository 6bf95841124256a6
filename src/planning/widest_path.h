// The path between two cells whose narrowest place is widest: the one that the largest vehicle takes.
//
//   const auto widest = widestPath(costs, options, start, goal, stop);
//   if (widest) use(widest->clearance, widest->narrowest);
//
// `clearance` is the largest radius, in metres, with which a path is found between cells where `radius`
// is too much, all other options being equal: exactly, since the cells are judged as inflation judges
// them. What is known of occupied cells, of unknown ones where they are not passable, and of the map's
// border counts as the options say. A best-first search over the distances of all cells: time in
// proportion to n log n for n cells.
#pragma once

#include <optional>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/costmap_options.h"

namespace grid_path_planner::planning {

struct WidestPath {
  double clearance = 0.0;  // m; no more than the radius that was asked about
  grid::Cell narrowest;    // the first cell of the path that has no more
  std::vector<grid::Cell> cells;
};

// `costs` is the costmap at full resolution of these options, or of others of the same classes. None where no
// radius lets a path through. Throws Stopped.
std::optional<WidestPath> widestPath(const costmap::CostGrid& costs,
                                     const costmap::CostmapOptions& options, grid::Cell start,
                                     grid::Cell goal, const base::StopToken& stop);

}  // namespace grid_path_planner::planning
