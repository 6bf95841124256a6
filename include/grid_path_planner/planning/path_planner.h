// From two poses on an occupancy map to a path: terrain, search, and what becomes of the two ends.
//
//   PathPlanner planner(options);
//   planner.setMap(std::make_shared<const OccupancyGrid>(readMapFile("site.yaml")));
//   Plan report = planner.plan({start, goal}, StopSource());
//
// The ends of the path are the poses asked for. They are judged on the inflated map at full
// resolution; where only their block of the kernel is blocked, the search runs at full resolution
// until it reaches open blocks. No call changes the caller's map. Not thread-safe: one at a time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/status.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/costmap_options.h"
#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/path/path.h"
#include "grid_path_planner/planners/planner.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planners/search_options.h"

namespace grid_path_planner::costmap {
class CostmapBuilder;
}  // namespace grid_path_planner::costmap

namespace grid_path_planner::planning {

class MultiResolutionPlanner;
struct CostmapPair;

struct PlannerOptions {
  costmap::CostmapOptions terrain;
  std::string planner = "weighted_jump_point";
  planners::SearchOptions search;
  double tolerance = 0.0;            // m
  double start_escape_radius = 0.0;  // m
  bool retry_finer = true;
  bool smooth = false;
  double timeout = 5.0;  // s; 0: none
  path::HeadingMode heading = path::HeadingMode::FORWARD;
  path::PathZ path_z = path::PathZ::INTERPOLATE;
  double fixed_z = 0.0;  // m
};

template <class Visitor>
void visitOptions(PlannerOptions& o, Visitor&& visit) {
  visit("planner", o.planner,
        base::OptionInfo{"Name of the algorithm", ""}
            .under("The search")
            .oneOf(planners::plannerNames));
  visitOptions(o.search, visit);
  visitOptions(o.terrain, visit);
  visit("tolerance", o.tolerance,
        base::OptionInfo{
            "How far from an occupied or unreachable goal a path may end; 0: no path then", "m", 0,
            10000}
            .under("What is asked for"));
  visit("start_escape_radius", o.start_escape_radius,
        base::OptionInfo{
            "How far the nearest passable cell may be from an occupied start; 0: no path then", "m",
            0, 10000});
  visit("retry_finer", o.retry_finer,
        base::OptionInfo{
            "Whether the search is repeated at kernel 1 where the kernel closes every path; "
            "false: UNREACHABLE",
            ""});
  visit(
      "smooth", o.smooth,
      base::OptionInfo{"Whether a path over the grid is straightened where that is legal and costs "
                       "nothing; needs "
                       "connectivity 8 and diagonal_cost sqrt2",
                       ""});
  visit("timeout", o.timeout, base::OptionInfo{"Limit of one planning; 0: none", "s", 0, 86400});
  visit("heading", o.heading, base::OptionInfo{"Where the vehicle looks along the path", ""});
  visit("path_z", o.path_z, base::OptionInfo{"Where the z of the path comes from", ""});
  visit("fixed_z", o.fixed_z, base::OptionInfo{"z of the path with path_z fixed", "m", -1e6, 1e6});
}

// Throws InputError naming the option for a value outside its limits and for combinations that
// contradict each other: smooth with connectivity 4 or unit diagonals.
void checkPlannerOptions(const PlannerOptions& options,
                         const planners::PlannerMaker& make_planner = planners::makePlanner);

// Both in the map's frame.
struct PoseRequest {
  path::Pose start;
  path::Pose goal;
  bool record_expanded = false;
};

struct Plan {
  base::Status status = base::Status::NO_MAP;
  std::string message;
  path::Path path;          // empty unless FOUND
  costmap::ExactCost cost;  // between the end cells, as in SearchResult
  double segment_cost = 0.0;
  double costValue() const { return cost.toDouble() + segment_cost; }
  bool optimal = false;  // the planner promises that no path of its kind (over the grid, or at
                         // any angle) costs less; never of a kernel or a smoothed path
  double length_m = 0.0;
  std::size_t cells = 0;  // of the path on the map that was searched
  int kernel = 1;         // of the map that was searched
  base::Statistics statistics;
  double preparation_time_s =
      0.0;  // terrain and what the planner makes of it; 0 if nothing changed
  std::vector<Eigen::Vector2d> expanded;  // centres of the expanded cells, metres
};

class PathPlanner {
 public:
  // Throws InputError for options that cannot be used.
  explicit PathPlanner(const PlannerOptions& options = {},
                       planners::PlannerMaker make_planner = planners::makePlanner);
  ~PathPlanner();
  PathPlanner(PathPlanner&&) noexcept;
  PathPlanner& operator=(PathPlanner&&) noexcept;

  // Throws InputError and keeps the old options where the new ones cannot be used.
  void setOptions(const PlannerOptions& options);
  const PlannerOptions& options() const { return options_; }

  // Throws InputError for a map without cells or with values outside -1..100 and keeps the old map.
  void setMap(std::shared_ptr<const grid::OccupancyGrid> map);
  // `map` has the geometry of the present one and differs from it only inside `changed`. Takes time
  // in proportion to `changed`, as does what the next call makes of it.
  void updateMap(std::shared_ptr<const grid::OccupancyGrid> map, const grid::CellRect& changed);
  bool hasMap() const { return map_ != nullptr; }
  const std::shared_ptr<const grid::OccupancyGrid>& map() const { return map_; }

  // The maps that plan() works on, made if the map or the options changed. Throws Stopped.
  // Precondition: hasMap().
  std::shared_ptr<const costmap::CostGrid> fullResolutionCosts(
      const base::StopToken& stop);  // kernel 1, inflated
  std::shared_ptr<const costmap::CostGrid> downsampledCosts(
      const base::StopToken& stop);  // options().terrain.kernel

  // Returns when all is made that plan() uses, the planner's background work too, without which the
  // first plans take longer. Throws Stopped. Precondition: hasMap().
  void finishPreparation(const base::StopToken& stop);

  // Every failure but a bug is a status; options().timeout runs beside the token's own limit.
  Plan plan(const PoseRequest& request, const base::StopSource& stop = {});

 private:
  friend class PlanAttempt;

  // The maps brought up to date.
  CostmapPair maps(const base::StopToken& stop);
  // The same, and what was made of them keeps up.
  CostmapPair followedMaps(const base::StopToken& stop);

  planners::PlannerMaker make_planner_;
  PlannerOptions options_;
  std::shared_ptr<const grid::OccupancyGrid> map_;
  std::unique_ptr<costmap::CostmapBuilder> terrain_;
  std::unique_ptr<MultiResolutionPlanner> routes_;
};

}  // namespace grid_path_planner::planning
