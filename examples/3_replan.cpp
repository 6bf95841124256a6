// The map changes while a vehicle drives: is the path blocked, and what does a new one cost?
//
// updateMap() takes the new map and the rectangles in which it differs. All that was made of the old
// map is repaired in proportion to these. The planner incremental_a_star keeps its search
// tree as well, so that a new plan expands only the cells that the change concerns.
#include <iostream>
#include <memory>

#include "grid_path_planner/planning/path_planner.h"
#include "grid_path_planner/planning/replan_policy.h"
#include "text_map.h"

using grid_path_planner::base::Status;
using grid_path_planner::base::StopToken;
using grid_path_planner::grid::Cell;
using grid_path_planner::grid::CellRect;
using grid_path_planner::grid::OccupancyGrid;
using grid_path_planner::path::Pose;
using grid_path_planner::planning::pathBlocked;
using grid_path_planner::planning::PathPlanner;
using grid_path_planner::planning::Plan;
using grid_path_planner::planning::PlannerOptions;

namespace {

bool show(const char* title, const OccupancyGrid& map, const Plan& plan) {
  std::cout << title << " (" << toString(plan.status) << ", " << plan.length_m << " m, "
            << plan.statistics.expanded << " cells expanded)\n";
  examples::print(map, plan.path);
  return plan.status == Status::FOUND;
}

}  // namespace

int main() {
  PlannerOptions options;
  options.planner = "incremental_a_star";
  options.smooth = false;  // all cells are printed
  PathPlanner planner(options);

  const auto map = std::make_shared<const OccupancyGrid>(examples::mapOf(
      {"........................", "................##......", "................##......",
       "..###########...##......", "............#...##......", "............#...##......",
       "............#...##......", "............#...##......"}));
  planner.setMap(map);
  const Pose start = {{8.5, 1.5, 0.0}, 0.0};
  const Pose goal = {{23.5, 1.5, 0.0}, 0.0};
  const Plan first = planner.plan({start, goal});
  if (!show("Before", *map, first)) return 1;

  // When the vehicle has driven nine metres, a sensor sees obstacles on the path.
  const CellRect changed = {6, 5, 3, 2};
  auto seen = std::make_shared<OccupancyGrid>(*map);
  for (const Cell cell : {Cell{6, 5}, Cell{7, 5}, Cell{8, 6}}) (*seen)[cell] = 100;
  planner.updateMap(seen, {changed});

  const Pose vehicle = {{1.5, 3.5, 0.0}, 0.0};
  const bool blocked = pathBlocked(first.path, vehicle.position.head<2>().eval(),
                                   *planner.fullResolutionCosts(StopToken()));
  std::cout << "Is the rest of the path blocked now? " << (blocked ? "yes" : "no") << '\n';

  const Plan second = planner.plan({vehicle, goal});
  return blocked && show("After", *seen, second) ? 0 : 1;
}
