// How a vehicle follows a path.
#pragma once

#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::following {

enum class FollowMode { CONTINUOUS, STOP_AT_EACH };
const std::vector<std::pair<const char*, FollowMode>>& choicesOf(FollowMode);

// What happens at a waypoint that was passed farther away than the acceptance radius.
enum class MissedPolicy { STOP, SKIP, RETRY };
const std::vector<std::pair<const char*, MissedPolicy>>& choicesOf(MissedPolicy);

// Where the vehicle faces: as the waypoints say, turning evenly between them; or along the path, and
// at a stop as the waypoint says.
enum class FacingMode { PATH_YAW, ALONG };
const std::vector<std::pair<const char*, FacingMode>>& choicesOf(FacingMode);

struct FollowerOptions {
  double max_speed = 0.8;             // m/s
  double max_vertical_speed = 0.4;    // m/s
  double max_yaw_rate = 0.8;          // rad/s
  double max_acceleration = 0.5;      // m/s^2
  double max_yaw_acceleration = 1.0;  // rad/s^2
  double position_gain = 1.2;         // 1/s
  double yaw_gain = 1.2;              // 1/s
  FollowMode mode = FollowMode::CONTINUOUS;
  FacingMode facing = FacingMode::PATH_YAW;
  double acceptance_radius = 0.3;    // m
  double position_tolerance = 0.05;  // m
  double yaw_tolerance = 0.05;       // rad
  double settle_time = 0.5;          // s
  bool hold_pose = true;
  double hold_distance = 0.5;     // m
  double hold_time = 60.0;        // s
  double pursuit_distance = 0.4;  // m
  double lookahead = 2.0;         // m
  bool loop = false;
  MissedPolicy missed_waypoint = MissedPolicy::SKIP;
  int max_retries = 3;
  double no_progress_timeout = 20.0;  // s
  double blocked_timeout = 0.0;       // s
  double pose_jump = 0.3;             // m
};

// Groups of the options, in the order of visitOptions.
template <class Visitor>
void visitSpeedOptions(FollowerOptions& o, Visitor&& visit) {
  visit("max_speed", o.max_speed,
        base::OptionInfo{"Speed along the path in the plane", "m/s", 0.01, 100.0}.under("Speeds"));
  visit("max_vertical_speed", o.max_vertical_speed,
        base::OptionInfo{"Speed up and down; steep parts are driven slower for it", "m/s", 0.01,
                         100.0});
  visit("max_yaw_rate", o.max_yaw_rate, base::OptionInfo{"Fastest turn", "rad/s", 0.01, 100.0});
  visit("max_acceleration", o.max_acceleration,
        base::OptionInfo{"Change of speed; not above the vehicle's own, or it overshoots", "m/s^2",
                         0.01, 100.0});
  visit("max_yaw_acceleration", o.max_yaw_acceleration,
        base::OptionInfo{"Change of the yaw rate; not above the vehicle's own, or it overshoots",
                         "rad/s^2", 0.01, 100.0});
  visit("position_gain", o.position_gain,
        base::OptionInfo{
            "Speed per metre off the path or before a stop; higher: stiffer, less stable", "1/s",
            0.05, 20.0});
  visit("yaw_gain", o.yaw_gain,
        base::OptionInfo{"Yaw rate per radian of error; higher: stiffer, less stable", "1/s", 0.05,
                         20.0});
}

template <class Visitor>
void visitWaypointOptions(FollowerOptions& o, Visitor&& visit) {
  visit("mode", o.mode,
        base::OptionInfo{"continuous passes intermediate waypoints, stop_at_each stops at them", ""}
            .under("How waypoints are driven"));
  visit("facing", o.facing,
        base::OptionInfo{"Where the vehicle looks; path_yaw: as the waypoints say, turning evenly "
                         "between them; along: where it drives",
                         ""});
  visit("acceptance_radius", o.acceptance_radius,
        base::OptionInfo{
            "A waypoint counts as reached this near; farther off the path the vehicle first "
            "returns to it",
            "m", 0.01, 100.0});
  visit("position_tolerance", o.position_tolerance,
        base::OptionInfo{
            "How near to the last waypoint, or to one it stops at, the vehicle must come", "m",
            0.001, 100.0});
  visit("yaw_tolerance", o.yaw_tolerance,
        base::OptionInfo{"How exactly it must look there as the waypoint says", "rad", 0.001, 3.2});
  visit("settle_time", o.settle_time,
        base::OptionInfo{"How long it must stay inside both tolerances for a stop", "s", 0.0,
                         3600.0});
  visit("hold_pose", o.hold_pose,
        base::OptionInfo{
            "Whether a vehicle that drifts off after its arrival is brought back; false: it "
            "is left alone",
            ""});
  visit("hold_distance", o.hold_distance,
        base::OptionInfo{"How far off it is still brought back; farther, it stands and says so",
                         "m", 0.0, 100.0});
  visit("hold_time", o.hold_time,
        base::OptionInfo{"How long after its arrival it is brought back; 0: not at all", "s", 0.0,
                         1e6});
  visit(
      "pursuit_distance", o.pursuit_distance,
      base::OptionInfo{"How far ahead on the path it steers to; longer: smoother, rounder corners",
                       "m", 0.01, 100.0});
  visit("lookahead", o.lookahead,
        base::OptionInfo{
            "How much of the path ahead must be free in the map; longer than it needs to brake",
            "m", 0.0, 1000.0});
  visit("loop", o.loop,
        base::OptionInfo{
            "Whether the path is driven again and again; a change counts for the next path", ""});
}

template <class Visitor>
void visitFailureOptions(FollowerOptions& o, Visitor&& visit) {
  visit(
      "missed_waypoint", o.missed_waypoint,
      base::OptionInfo{"What happens at a waypoint that was not reached; each one is reported", ""}
          .under("What goes wrong"));
  visit("max_retries", o.max_retries,
        base::OptionInfo{"How often one drive may retry before it fails", "", 0, 1000000});
  visit("no_progress_timeout", o.no_progress_timeout,
        base::OptionInfo{"The drive fails this long after the last progress; 0: never", "s", 0.0,
                         1e6});
  visit("blocked_timeout", o.blocked_timeout,
        base::OptionInfo{"The drive fails when it has been blocked this long; 0: it waits for ever",
                         "s", 0.0, 1e6});
  visit("pose_jump", o.pose_jump,
        base::OptionInfo{"The drive ends, and a pose is held no more, when the vehicle's pose "
                         "changes by so much more than it can drive meanwhile; 0: never",
                         "m", 0.0, 1000.0});
}

template <class Visitor>
void visitOptions(FollowerOptions& o, Visitor&& visit) {
  visitSpeedOptions(o, visit);
  visitWaypointOptions(o, visit);
  visitFailureOptions(o, visit);
}

// Throws InputError naming the option for a value outside its limits, for a position_tolerance
// above the acceptance_radius.
void checkFollowerOptions(const FollowerOptions& options);

}  // namespace grid_path_planner::following
