// One planning of a PathPlanner: what becomes of the two ends, then the route, then the path.
#pragma once

#include <optional>
#include <string>

#include "grid_path_planner/planning/multi_resolution_planner.h"
#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::planning {

class PlanAttempt {
 public:
  // The planner is prepared. All three outlive the attempt.
  PlanAttempt(PathPlanner& planner, const PoseRequest& request, const base::StopToken& stop);

  // Throws Stopped and TooExpensive.
  Plan run();

 private:
  // An end of the path: the cell it is searched from, and where the path ends.
  struct End {
    grid::Cell cell;
    Eigen::Vector2d position;
    std::string note;    // what the answer should say about it, "" if nothing
    bool moved = false;  // the cell is not the one that was asked for
  };

  // None where the report says why.
  std::optional<End> startEnd(Plan& report) const;
  // Out of a blocked start: the nearest cell within start_escape_radius of which `usable` holds, or
  // of those from which the goal can be reached.
  template <class Usable>
  std::optional<End> escapeStart(Usable&& usable) const;
  std::optional<End> escapeTowards(const End& goal) const;
  std::optional<End> goalEnd(const End& start, Plan& report);
  std::optional<End> substituteGoal(const End& start, const std::string& why);
  std::string whyBlocked(grid::Cell cell) const;

  Route search(const End& start, const End& goal);
  void fill(Plan& report, const End& start, const End& goal, Route route) const;
  path::Path pathOf(const End& start, const End& goal, const Route& route) const;

  PathPlanner& planner_;
  const PoseRequest& request_;
  const base::StopToken& stop_;
  std::shared_ptr<const costmap::CostGrid> fine_;
};

}  // namespace grid_path_planner::planning
