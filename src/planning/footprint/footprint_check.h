// Whether a vehicle's footprint keeps off obstacles along a path, at its ends and between (vehicle/sweep.h).
//
//   FootprintCheck check(footprint, costs, options);
//   check.allowFor({start, goal});
//   const auto contacts = check.contacts(path, start.yaw, goal.yaw, stop);  // none: it fits
//
// Obstacles are occupied cells; unknown ones where a round vehicle would keep its radius from them by itself
// (unknown_is_passable false, radius_to_unknown -1); and what lies outside the map where `outside` treats it as one of these.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/planning/path_planner.h"
#include "vehicle/sweep.h"

namespace grid_path_planner::planning {

class FootprintCheck {
 public:
  // `costs` is the costmap at full resolution; it outlives this. Precondition: the footprint is not empty.
  FootprintCheck(const vehicle::Footprint& footprint, const costmap::CostGrid& costs,
                 const PlannerOptions& options);

  // Where the footprint meets unknown cells or the outside at one of these poses, they are no obstacles from now on:
  // a path keeps no more from them than its ends have. A goal that is replaced is no end.
  void allowFor(const std::vector<path::Pose>& ends);
  // What that says in a plan's message; "" where nothing was allowed.
  std::string note() const;

  // What is wrong with a pose, from "meets the occupied cell at ..."; "" where nothing is.
  std::string complaint(const path::Pose& pose) const;
  // `path` has the headings of the options. Each of `start_yaw` and `goal_yaw` counts where it is given. Throws Stopped.
  std::optional<vehicle::FootprintContact> first(const path::Path& path,
                                                 std::optional<double> start_yaw,
                                                 std::optional<double> goal_yaw,
                                                 const base::StopToken& stop) const;
  // Wherever the footprint meets an obstacle, once a footprint's length.
  std::vector<vehicle::FootprintContact> contacts(const path::Path& path,
                                                  std::optional<double> start_yaw,
                                                  std::optional<double> goal_yaw,
                                                  const base::StopToken& stop) const;
  // "meets the occupied cell at (1, 2) with the vehicle at (1, 1.5), heading 90 deg".
  std::string text(const vehicle::FootprintContact& contact) const;

 private:
  struct Counted {
    bool unknown;
    bool outside;
  };

  vehicle::FootprintSweep sweepOver(bool occupied, Counted counted) const;
  std::string cellText(grid::Cell cell) const;

  const vehicle::Footprint& footprint_;
  const costmap::CostGrid& costs_;
  const path::HeadingMode heading_;
  Counted counted_;
  Counted allowed_{false, false};
  vehicle::FootprintSweep sweep_;
};

}  // namespace grid_path_planner::planning
