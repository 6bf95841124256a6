// The parameters of the node `navigate_path`.
#pragma once

#include <string>

#include "grid_path_planner/following/follower_options.h"

namespace grid_path_planner::nodes {

struct NavigatePathOptions {
  std::string config_filename;
  bool join_nearest = false;
  bool follow_latched = false;
  following::FollowerOptions follower;
  bool check_map = true;
  double check_radius = 0.0;  // m
  int occupied_min = 65;      // %
  std::string base_frame = "base_link";
  double tf_timeout = 0.5;     // s
  double control_rate = 50.0;  // Hz, wall time
};

template <class Visitor>
void visitOptions(NavigatePathOptions& o, Visitor&& visit) {
  visit("config_filename", o.config_filename,
        base::OptionInfo{
            "Waypoint file to drive, below the folder to load from; then the topic path is "
            "ignored; read at the start",
            ""}
            .under("What is driven"));
  visit("join_nearest", o.join_nearest,
        base::OptionInfo{
            "Whether a file is joined at its nearest point instead of its first waypoint", ""});
  visit("follow_latched", o.follow_latched,
        base::OptionInfo{
            "Whether a path stamped before the node started is driven too, however old it is", ""});
  visitOptions(o.follower, visit);
  visit("check_map", o.check_map,
        base::OptionInfo{"Whether the vehicle stops before occupied cells of projected_map; false: "
                         "obstacles are ignored",
                         ""}
            .under("The map"));
  visit("check_radius", o.check_radius,
        base::OptionInfo{"How far from the path cells count too; not above the planner's radius",
                         "m", 0.0, 100.0});
  visit("occupied_min", o.occupied_min,
        base::OptionInfo{"Cells with at least this occupancy are occupied; lower: more obstacles",
                         "%", 1, 100});
  visit(
      "base_frame", o.base_frame,
      base::OptionInfo{"Frame of the vehicle, whose pose tf gives and in which it is commanded", ""}
          .under("The vehicle's pose"));
  visit("tf_timeout", o.tf_timeout,
        base::OptionInfo{"The vehicle stops while its newest pose is older", "s", 0.01, 3600.0});
  visit(
      "control_rate", o.control_rate,
      base::OptionInfo{"How often the velocity is computed, by the wall clock; simulated time that "
                       "runs faster needs more",
                       "Hz", 1.0, 1000.0});
}

// Throws InputError naming the option for a value outside its limits, options that
// checkFollowerOptions refuses, and an empty base_frame.
void checkNavigatePathOptions(const NavigatePathOptions& options);

}  // namespace grid_path_planner::nodes
