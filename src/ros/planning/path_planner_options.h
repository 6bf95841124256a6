// Options of the node path_planner: those of the planning itself and those of the node around it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/planning/path_planner.h"
#include "ros/messages/zero_heading.h"
#include "vehicle/description.h"

namespace grid_path_planner::nodes {

enum class GoalZ { MESSAGE, VEHICLE };
const std::vector<std::pair<const char*, GoalZ>>& choicesOf(GoalZ);

struct PathPlannerNodeOptions {
  planning::PlannerOptions planner;
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  double map_data_timeout = 3.0;  // s
  double tf_timeout = 0.5;        // s, steady clock
  ZeroHeading zero_heading = ZeroHeading::REFUSED;
  GoalZ goal_z_from = GoalZ::MESSAGE;
  double replan_period = 0.0;      // s, ROS time; 0: never
  double replan_hysteresis = 0.1;  // of the new path's cost
  double pose_spacing = -1.0;      // m; -1: a cell of the map
  std::string waypoints_file;      // "": none
  bool record_search = true;
  double full_map_period = 10.0;  // s, steady clock
  bool publish_rectangles = false;
  std::optional<vehicle::Description> vehicle = {};  // from ~vehicle
};

// A group of the options, in the order of visitOptions.
template <class Visitor>
void visitPoseOptions(PathPlannerNodeOptions& o, Visitor&& visit) {
  visit("map_frame", o.map_frame,
        base::OptionInfo{
            "Frame of maps and goals that name none, and of results before there is a map", ""}
            .under("The node"));
  visit("map_data_timeout", o.map_data_timeout,
        base::OptionInfo{
            "A plan says so, and diagnostics warn, where the newest cloud or scan in a map "
            "that has a heartbeat is older; navigate_path holds then",
            "s", 0.1, 3600.0});
  visit("base_frame", o.base_frame,
        base::OptionInfo{
            "Frame of the vehicle, where paths start, unless initialpose said otherwise", ""});
  visit("tf_timeout", o.tf_timeout,
        base::OptionInfo{"How old a transform of the vehicle, a goal or a start may be, and how "
                         "long one is waited for "
                         "before TRANSFORM_ERROR; 0: no wait, and any age",
                         "s", 0, 60});
  visitZeroHeading(o.zero_heading, visit);
  visit("goal_z_from", o.goal_z_from,
        base::OptionInfo{
            "Where the z of a goal comes from; vehicle: it is that of the start, for goals "
            "of rviz have z = 0",
            ""});
}

template <class Visitor>
void visitOptions(PathPlannerNodeOptions& o, Visitor&& visit) {
  visitOptions(o.planner, visit);
  visitPoseOptions(o, visit);
  visit("replan_period", o.replan_period,
        base::OptionInfo{
            "ROS time between two plannings for the same goal, 20 in a second of the wall clock at "
            "most; 0: only a new goal or a blocked path is planned for",
            "s", 0, 86400});
  visit(
      "replan_hysteresis", o.replan_hysteresis,
      base::OptionInfo{"By which part of its own cost a new path must be cheaper than the old one, "
                       "while that is passable, to "
                       "replace it; 0.1: the old one costs more than 1.1 times as much",
                       "", 0, 1000});
  visit(
      "pose_spacing", o.pose_spacing,
      base::OptionInfo{
          "Distance between poses of published and answered paths at most, in equal parts between "
          "corners, for followers that go from pose to pose; -1: one cell of the map; 0: corners "
          "only",
          "m", -1, 10000});
  visit("waypoints_file", o.waypoints_file,
        base::OptionInfo{
            "Waypoint file that every found plan is written to, below the folder to save in; "
            "empty: none",
            ""});
  visit("record_search", o.record_search,
        base::OptionInfo{
            "Whether search_markers, while someone listens, show the expanded cells; false saves "
            "16 bytes for each",
            ""});
  visit("full_map_period", o.full_map_period,
        base::OptionInfo{
            "How long after a change all of planning_map is sent at the latest, by the wall clock; "
            "until then a receiver that lost an update may go without it",
            "s", 0.1, 3600.0});
  visit("publish_rectangles", o.publish_rectangles,
        base::OptionInfo{"Whether rectangle_map and rectangle_markers show the searched map as "
                         "rectangles, cut anew whenever it changes",
                         ""});
}

// Sets what the vehicle's description says: outline, least turning radius, and where no radius is set that of the outline
// and 0.05 m. Throws InputError naming an option that is neither its default nor what the description says.
void takeFromVehicle(PathPlannerNodeOptions& options);

// Throws InputError naming the option, also for a radius inside the vehicle's outline.
void checkPathPlannerNodeOptions(const PathPlannerNodeOptions& options);

}  // namespace grid_path_planner::nodes
