// Options of planning on costs that are given: those of PlannerOptions that have a meaning there.
#pragma once

#include <string>

#include "grid_path_planner/planning/path_planner.h"
#include "planning/cost_weights.h"

namespace grid_path_planner::planning {

struct CostPlannerOptions {
  std::string planner = "weighted_jump_point";
  planners::SearchOptions search;
  CostWeightOptions weights;
  costmap::MotionModel motion;
  bool use_footprint = false;
  double default_tolerance = 0.0;    // m
  double start_escape_radius = 0.1;  // m
  bool smooth = true;
  double timeout = 5.0;  // s; 0: none
  path::HeadingMode heading = path::HeadingMode::FORWARD;
};

template <class Visitor>
void visitOptions(CostPlannerOptions& o, Visitor&& visit) {
  visit("planner", o.planner,
        base::OptionInfo{"Name of the algorithm", ""}
            .under("The search")
            .oneOf(planners::plannerNames));
  visitOptions(o.search, visit);
  visitOptions(o.weights, visit);
  visit("connectivity", o.motion.connectivity,
        base::OptionInfo{"Neighbours of a cell: 8 or 4", ""}.under("How the costmap is searched"));
  visit("diagonal_cost", o.motion.diagonal_cost,
        base::OptionInfo{"Length of a diagonal step: sqrt2, or unit (1)", ""});
  visit("cut_corners", o.motion.cut_corners,
        base::OptionInfo{"Whether a diagonal step may pass a blocked cell's corner", ""});
  visit(
      "use_footprint", o.use_footprint,
      base::OptionInfo{
          "Whether the costmap's own footprint, padded as there, meets no cell of cost 254 on a "
          "path, "
          "turns on the spot included; where no such path is found there is none. false: only the "
          "inscribed radius counts",
          ""}
          .under("The vehicle's shape"));
  visit(
      "default_tolerance", o.default_tolerance,
      base::OptionInfo{"How far from a blocked or unreachable goal a path may end, where who asks "
                       "names no tolerance; 0: no path then",
                       "m", 0, 10000}
          .under("What is asked for"));
  visit("start_escape_radius", o.start_escape_radius,
        base::OptionInfo{
            "How far the nearest passable cell may be from a start of cost 253 or 254, on "
            "a straight line that comes no nearer to cost 254 than the start is; from inside cost "
            "254 it leads out by the nearest edge; 0: no path then",
            "m", 0, 10000});
  visit("smooth", o.smooth,
        base::OptionInfo{
            "Whether a path over the grid is straightened where that is legal and costs nothing; "
            "false: it follows the grid's eight directions",
            ""});
  visit("timeout", o.timeout, base::OptionInfo{"Limit of one planning; 0: none", "s", 0, 86400});
  visit("heading", o.heading, base::OptionInfo{"Where the vehicle looks along the path", ""});
}

// Throws InputError naming the option for a value outside its limits, for an unknown planner and for
// combinations that contradict each other.
void checkCostPlannerOptions(const CostPlannerOptions& options);

// The same for planOnCosts(). `inscribed_radius`: metres, for messages.
PlannerOptions plannerOptions(const CostPlannerOptions& options, double inscribed_radius);

}  // namespace grid_path_planner::planning
