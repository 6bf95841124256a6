// The parameters of the node `navigate_path`.
#pragma once

#include <optional>
#include <string>

#include "grid_path_planner/following/follower_options.h"
#include "grid_path_planner/following/path_clearance_check.h"
#include "ros/gate/localization_gate.h"
#include "ros/guard/scheduling/realtime_priority.h"
#include "ros/messages/zero_heading.h"
#include "vehicle/description.h"

namespace grid_path_planner::nodes {

struct NavigatePathOptions {
  std::string config_filename;
  bool join_nearest = false;
  bool follow_latched = false;
  ZeroHeading zero_heading = ZeroHeading::REFUSED;
  following::FollowerOptions follower;
  bool check_map = true;
  following::ClearanceLimits limits;
  std::string check_footprint;  // "[[x, y], ...]", m; "": check_radius alone
  bool require_vehicle = false;
  std::optional<vehicle::Description> vehicle = {};  // from ~vehicle
  double map_timeout = 3.0;                          // s, wall time
  double map_data_timeout = 3.0;                     // s
  std::string map_frame = "map";
  bool use_speed_limit = false;
  std::string base_frame = "base_link";
  double tf_timeout = 0.5;  // s
  DegradedDriving degraded;
  double control_rate = 50.0;  // Hz, wall time
  int realtime_priority = 1;
  double master_timeout = 30.0;  // s, wall time
  bool share_cmd_vel = false;
};

// A group of the options, in the order of visitOptions.
template <class Visitor>
void visitMapOptions(NavigatePathOptions& o, Visitor&& visit) {
  visit("check_map", o.check_map,
        base::OptionInfo{"Whether the vehicle stops before occupied cells of projected_map, and "
                         "stands while there is no map; false: obstacles are ignored",
                         ""}
            .under("The map"));
  visit("check_radius", o.limits.radius,
        base::OptionInfo{"How far from the path cells count too; not above the planner's radius",
                         "m", 0.0, 100.0});
  visit(
      "check_footprint", o.check_footprint,
      base::OptionInfo{
          "Corners of a vehicle that is not round, as path_planner's footprint: it stops before it "
          "would meet occupied cells, looking along the path; empty: check_radius alone",
          "m"});
  visit("require_vehicle", o.require_vehicle,
        base::OptionInfo{"Whether the node refuses to start without the description of a vehicle "
                         "(doc/vehicle.md); false: without one it drives as a point and checks no "
                         "motion",
                         ""});
  visit("occupied_min", o.limits.thresholds.occupied_min,
        base::OptionInfo{"Cells with at least this occupancy are occupied; lower: more obstacles",
                         "%", 1, 100});
  visit("stop_at_unknown", o.limits.stop_at_unknown,
        base::OptionInfo{"Whether the vehicle stops before unknown cells and the map's border too",
                         ""});
  visit("free_max", o.limits.thresholds.free_max,
        base::OptionInfo{"Cells with more occupancy, and less than occupied_min, are unknown; "
                         "counts with stop_at_unknown",
                         "%", 0, 99});
  visit("map_timeout", o.map_timeout,
        base::OptionInfo{
            "The vehicle stands while a map that has had a heartbeat has been without one for so "
            "long, by the wall clock; above the heartbeat_period of projected_map",
            "s", 0.1, 3600.0});
  visit("map_data_timeout", o.map_data_timeout,
        base::OptionInfo{
            "The vehicle stands while the newest cloud or scan in a map that has a heartbeat is "
            "older; "
            "above the time between two clouds, and what they take to be mapped. At least so long "
            "another publisher that sends maps again and again may have sent none while it was "
            "driven",
            "s", 0.1, 3600.0});
  visit("map_frame", o.map_frame,
        base::OptionInfo{"Frame of paths and maps whose header names none", ""});
  visit("use_speed_limit", o.use_speed_limit,
        base::OptionInfo{"Whether the vehicle stands until a map of speed limits has come on "
                         "speed_limit; one that comes is heeded in any case",
                         ""});
}

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
  visitZeroHeading(o.zero_heading, visit);
  visitOptions(o.follower, visit);
  visitMapOptions(o, visit);
  visit(
      "base_frame", o.base_frame,
      base::OptionInfo{"Frame of the vehicle, whose pose tf gives and in which it is commanded", ""}
          .under("The vehicle's pose"));
  visit("tf_timeout", o.tf_timeout,
        base::OptionInfo{"The vehicle stops while its newest pose is older, or what joins its "
                         "path's frame to the map's",
                         "s", 0.01, 3600.0});
  visit("degraded_speed", o.degraded.speed,
        base::OptionInfo{"Share of max_speed that is driven while localization_status says "
                         "DEGRADED; while it says LOST, or has ceased, the vehicle stands",
                         "", 0.01, 1.0});
  visit("degraded_time", o.degraded.time,
        base::OptionInfo{"How long it is driven so; then it stands, and ~resume drives on for as "
                         "long",
                         "s", 0.0, 1e6});
  visit(
      "control_rate", o.control_rate,
      base::OptionInfo{"How often the velocity is computed, by the wall clock; simulated time that "
                       "runs faster needs more",
                       "Hz", 1.0, 1000.0});
  visitRealtimePriority(o.realtime_priority, visit);
  visit("master_timeout", o.master_timeout,
        base::OptionInfo{"The vehicle stands when the ROS master has not answered for so long, by "
                         "the wall clock; 0: it drives on",
                         "s", 0.0, 86400.0}
            .under("Other nodes"));
  visit("share_cmd_vel", o.share_cmd_vel,
        base::OptionInfo{"Whether the node starts where another publishes cmd_vel too; true only "
                         "where the two never drive at once",
                         ""});
}

// Sets what the vehicle's description says: speeds, accelerations, how long a pose is held, and the outline for the
// check ahead. Throws InputError naming an option that is neither its default nor what the description says, and a check_radius
// inside the outline.
void takeFromVehicle(NavigatePathOptions& options);

// Throws InputError naming the option for a value outside its limits, options that
// checkFollowerOptions refuses, and an empty map_frame or base_frame.
void checkNavigatePathOptions(const NavigatePathOptions& options);

}  // namespace grid_path_planner::nodes
