// Plans a path between two poses on costs of a byte a cell that somebody else made, such as
// costmap_2d, with the footprint and the inflation already in them.
//
//   CostPlanner planner(options);
//   planner.setCosts(geometry, costmap.getCharMap(), inscribed_radius);  // under the costmap's mutex
//   Plan plan = planner.plan({start, goal}, tolerance, source);          // without it
//
// setCosts() compares the costs with those before and copies what differs. plan() makes weights of
// that only (cost_weights.h), and updates what the planner prepared; other sides, another resolution or
// another origin of the map begin anew.
//
// With use_footprint the vehicle's own footprint, which setFootprint() gives, meets no cell of cost 254 on the path
// (planning/footprint/fitted_plan.h), nor one of 255 without allow_unknown, unless it does so at an end.
// No cell that a path touches is of cost 253 or 254, nor of 255 without allow_unknown, but on the
// first segment of a start that is itself in one. The costs are never written.
// Not thread-safe: one call at a time.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/grid/double_buffered.h"
#include "grid_path_planner/planning/plan.h"
#include "planning/cost_planner_options.h"
#include "planning/multi_resolution_planner.h"

namespace grid_path_planner::planning {

class CostPlanner {
 public:
  // Throws InputError for options that cannot be used.
  explicit CostPlanner(const CostPlannerOptions& options = {},
                       planners::PlannerMaker make_planner = planners::makePlanner);

  // Throws InputError and keeps the old options where the new ones cannot be used.
  void setOptions(const CostPlannerOptions& options);
  const CostPlannerOptions& options() const { return options_; }

  // `costs`: row by row as in nav_msgs/OccupancyGrid, not read after the call. `inscribed_radius`:
  // metres, for messages. Throws InputError, and keeps the old costs, where the map and what is made of
  // it would take more than the memory limit.
  void setCosts(const grid::GridGeometry& geometry, const Cost* costs, double inscribed_radius);
  // Corners in metres, base_link; they count from the next plan() on, which answers INVALID_REQUEST where they are no
  // footprint (vehicle/footprint.h) and use_footprint asks for one.
  void setFootprint(std::vector<Eigen::Vector2d> corners) { footprint_ = std::move(corners); }
  // Cells in the rectangles of which weights are to be made by the next plan().
  std::size_t changedCells() const;

  // Every failure but a bug is a status; options().timeout runs beside the token's own limit.
  // `tolerance`: metres, in the place of options().default_tolerance.
  Plan plan(const PoseRequest& request, double tolerance, const base::StopSource& stop = {});

  // The costmap that the last plan() searched; null before. Its revision grows with every change.
  std::shared_ptr<const costmap::CostGrid> searched() const { return weights_.current(); }

 private:
  void checkMemory(const grid::GridGeometry& geometry) const;
  CostmapPair costmaps(const base::StopToken& stop);
  Plan planOn(const costmap::CostGrid& costs, const PoseRequest& request,
              const PlannerOptions& options, const base::StopToken& stop);

  planners::PlannerMaker make_planner_;
  CostPlannerOptions options_;
  double inscribed_radius_ = 0.0;  // m
  std::vector<Eigen::Vector2d> footprint_;
  grid::Grid<Cost> costs_;
  std::vector<grid::CellRect> changed_;  // of costs_, since weights_ were made
  grid::DoubleBuffered<costmap::CostGrid, costmap::CostGrid::Change> weights_;
  std::unique_ptr<MultiResolutionPlanner> search_;
};

}  // namespace grid_path_planner::planning
