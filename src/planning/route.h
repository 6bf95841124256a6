// A path over cells in one to three legs, and the path between two poses that it becomes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planners/planner.h"
#include "grid_path_planner/planning/plan.h"
#include "planning/end_segments.h"

namespace grid_path_planner::planning {

// The part of a route on one costmap.
struct Leg {
  std::shared_ptr<const costmap::CostGrid> map;
  planners::SearchResult result;  // FOUND; its expanded cells are in the route's plan
};

struct Route {
  Plan plan;              // without path, length and cells yet
  std::vector<Leg> legs;  // a leg's last cell and the next one's first are the same place or block
  bool shortest = false;  // of any angle, and none is shorter: smoothing cannot improve it
};

// Smooths every leg by itself. Preconditions as for smoothResult().
void smoothRoute(Route& route, const base::StopToken& stop);

// Gives the route the cost that it has on another costmap of the same geometry. Precondition: FOUND, with kernel 1.
void priceRoute(Route& route, const costmap::CostGrid& costs);

// Whether the line between two points in metres is legal (costmap/line_of_sight.h).
bool straightLineLegal(const costmap::CostGrid& map, const Eigen::Vector2d& from,
                       const Eigen::Vector2d& to);

// An end of the path, in metres: the pose's position, and the centre of the cell that was searched
// from, which a straight line joins to it.
struct RouteEnd {
  Eigen::Vector2d position;
  Eigen::Vector2d centre;
  std::optional<Eigen::Vector2d> escape = {};  // by which a start is left that is itself blocked
};

// The positions (z 0) and no headings yet. The middle of the first or last cell or block stays
// between an end and the rest only where the straight line past it is not legal; the cell's centre
// beside it only where the line to that middle is not. start = goal: one pose. Precondition: the route
// was found; `segments` are of the costmap at full resolution.
path::Path pathOfRoute(const Route& route, const RouteEnd& start, const RouteEnd& goal,
                       const EndSegments& segments);

}  // namespace grid_path_planner::planning
