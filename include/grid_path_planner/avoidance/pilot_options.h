// How a vehicle flies through what it sees.
#pragma once

#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::avoidance {

// What counts as open. published: whatever no remembered point closes, as in the paper. safe: what was
// seen and is empty, with a distance about every step.
enum class Rules { PUBLISHED, SAFE };
const std::vector<std::pair<const char*, Rules>>& choicesOf(Rules);

// direction: the best single direction (3DVFH+). tree: 3DVFH*. grid: A* over the remembered voxels, of
// which those never seen may hold a path.
enum class Search { DIRECTION, TREE, GRID };
const std::vector<std::pair<const char*, Search>>& choicesOf(Search);

struct PilotOptions {
  Rules rules = Rules::SAFE;
  Search search = Search::GRID;
  double look_ahead = 8.0;         // m
  double memory = 3600.0;          // s
  double d_safe = 0.6;             // m
  double goal_weight = 1.0;        // w_g
  double smooth_weight = 1.0;      // w_s
  double pitch_cost = 30.0;        // 1/degree
  double yaw_cost = 3.0;           // 1/degree
  double heuristic_weight = 30.0;  // 1/m
  double bin = 6.0;                // degrees
  double step = 1.0;               // m, alpha
  int children = 8;                // of a node
  double spacing = 0.5;            // m, xi
  double widening = 0.0;           // m
  int nodes = 60;                  // eta
  bool accumulate = true;
  double hysteresis = 0.1;
  int grid_nodes = 20000;
  double unseen_cost = 1.5;

  double max_speed = 2.0;         // m/s
  double max_climb = 1.0;         // m/s
  double max_yaw_rate = 0.5236;   // rad/s
  double max_acceleration = 2.0;  // m/s^2
  double response_time = 0.15;    // s
  bool elevation = true;
  bool sway = true;
  double z_min = -1e4;  // m, the fence
  double z_max = 1e4;

  double range_min = 0.2;         // m
  double range_max = 10.0;        // m
  double frame_period = 0.1;      // s
  double no_return_clears = 0.0;  // m
  double start_clear = 1.5;       // m
  double band_below = 100.0;      // m
  double band_above = 100.0;      // m
  double cloud_timeout = 0.4;     // s

  double arrival_radius = 1.0;  // m
  double home_radius = 0.5;     // m
  bool recover = true;
  double progress_timeout = 10.0;  // s
  double stuck_timeout = 30.0;     // s
};

// Groups of the options, in the order of visitOptions.
template <class Visitor>
void visitSearchOptions(PilotOptions& o, Visitor&& visit) {
  visit("rules", o.rules,
        base::OptionInfo{
            "What counts as open; published repeats the paper and runs into things; safe "
            "never enters what was not seen",
            ""}
            .under("Search"));
  visit(
      "search", o.search,
      base::OptionInfo{"direction: the best single direction; tree: the paper's; grid: A* over the "
                       "remembered voxels, which finds paths out of traps",
                       ""});
  visit("look_ahead", o.look_ahead,
        base::OptionInfo{"How far from the vehicle nodes of the tree are expanded; farther: fewer "
                         "traps, slower",
                         "m", 0.0, 12.0});
  visit("memory", o.memory,
        base::OptionInfo{"How long what was seen is remembered; 0: the newest frame only", "s", 0.0,
                         1e6});
  visit("d_safe", o.d_safe,
        base::OptionInfo{
            "Distance kept from every point; the vehicle's radius and a margin for drift "
            "and gusts",
            "m", 0.05, 5.0});
  visit("goal_weight", o.goal_weight,
        base::OptionInfo{"Cost of a direction that differs from the goal's", "", 0.0, 1e6});
  visit("smooth_weight", o.smooth_weight,
        base::OptionInfo{"Cost of a direction that differs from the one before; higher: smoother",
                         "", 0.0, 1e6});
  visit("pitch_cost", o.pitch_cost,
        base::OptionInfo{"Cost of a difference in elevation; higher: rather around than over",
                         "1/degree", 0.0, 1e6});
  visit("yaw_cost", o.yaw_cost,
        base::OptionInfo{"Cost of a difference in azimuth", "1/degree", 0.0, 1e6});
  visit("heuristic_weight", o.heuristic_weight,
        base::OptionInfo{"Cost of a metre to the goal; higher: straighter to it", "1/m", 0.0, 1e6});
}

template <class Visitor>
void visitTreeOptions(PilotOptions& o, Visitor&& visit) {
  visit("bin", o.bin,
        base::OptionInfo{"Width of the histogram's bins; smaller: finer, slower", "degrees", 2.0,
                         30.0}
            .under("The tree and the grid"));
  visit("step", o.step, base::OptionInfo{"Length of the tree's edges", "m", 0.2, 5.0});
  visit("children", o.children,
        base::OptionInfo{"Most children of a node; more: wider, slower", "", 1, 32});
  visit("spacing", o.spacing,
        base::OptionInfo{"Least distance between the children of a node", "m", 0.0, 10.0});
  visit("widening", o.widening,
        base::OptionInfo{
            "Under the rules published: points this near beside a direction close it, as "
            "3DVFH+ widens them; at most d_safe; 0: only those in its own bin",
            "m", 0.0, 10.0});
  visit("nodes", o.nodes,
        base::OptionInfo{"Nodes expanded in one search; more: longer paths around, slower", "", 1,
                         1000});
  visit(
      "accumulate", o.accumulate,
      base::OptionInfo{"Whether a node's cost is the sum along its branch; false: counted from the "
                       "vehicle, as the paper's text says",
                       ""});
  visit(
      "hysteresis", o.hysteresis,
      base::OptionInfo{"A path that is still free is kept unless another is cheaper by this share; "
                       "higher: fewer changes of mind",
                       "", 0.0, 1.0});
  visit("grid_nodes", o.grid_nodes,
        base::OptionInfo{
            "Voxels expanded in one search of the grid; more: longer paths around, slower", "", 100,
            200000});
  visit("unseen_cost", o.unseen_cost,
        base::OptionInfo{
            "Cost of a metre through voxels never seen, of which the grid's search hopes "
            "that they are free; higher: rather through known space",
            "", 1.0, 100.0});
}

template <class Visitor>
void visitVehicleOptions(PilotOptions& o, Visitor&& visit) {
  visit("max_speed", o.max_speed,
        base::OptionInfo{"Speed where enough is free ahead", "m/s", 0.01, 100.0}.under(
            "The vehicle"));
  visit("max_climb", o.max_climb, base::OptionInfo{"Speed up and down", "m/s", 0.01, 100.0});
  visit("max_yaw_rate", o.max_yaw_rate, base::OptionInfo{"Fastest turn", "rad/s", 0.01, 100.0});
  visit("max_acceleration", o.max_acceleration,
        base::OptionInfo{"How fast it brakes for certain; not above the vehicle's own, or it stops "
                         "too late",
                         "m/s^2", 0.01, 100.0});
  visit("response_time", o.response_time,
        base::OptionInfo{"How long the vehicle takes to answer a command; longer: slower near "
                         "obstacles",
                         "s", 0.0, 10.0});
  visit("elevation", o.elevation,
        base::OptionInfo{"Whether it may leave its height; false for ground vehicles", ""});
  visit("sway", o.sway,
        base::OptionInfo{"Whether it can move sideways; false: it turns first", ""});
  visit("z_min", o.z_min, base::OptionInfo{"Lowest height of the fence", "m", -1e4, 1e4});
  visit("z_max", o.z_max, base::OptionInfo{"Highest height of the fence", "m", -1e4, 1e4});
}

template <class Visitor>
void visitSensorOptions(PilotOptions& o, Visitor&& visit) {
  visit("range_min", o.range_min,
        base::OptionInfo{"Nearer points are not believed", "m", 0.0, 100.0}.under("Sensor"));
  visit("range_max", o.range_max,
        base::OptionInfo{"Farther points are not believed", "m", 0.1, 1000.0});
  visit(
      "frame_period", o.frame_period,
      base::OptionInfo{"Time between two frames; longer: slower near obstacles", "s", 0.001, 10.0});
  visit("no_return_clears", o.no_return_clears,
        base::OptionInfo{
            "How far a pixel without return, all of whose neighbours have none, counts "
            "as seen free; 0: not at all. Glass and black surfaces return nothing either",
            "m", 0.0, 1000.0});
  visit(
      "start_clear", o.start_clear,
      base::OptionInfo{"Radius about the start that counts as seen free; the camera cannot see it",
                       "m", 0.0, 100.0});
  visit("band_below", o.band_below,
        base::OptionInfo{
            "What lies this much lower than the vehicle is no obstacle; small for ground "
            "vehicles, whose floor it takes away",
            "m", 0.0, 100.0});
  visit("band_above", o.band_above,
        base::OptionInfo{"What lies this much higher than the vehicle is no obstacle", "m", 0.0,
                         100.0});
  visit("cloud_timeout", o.cloud_timeout,
        base::OptionInfo{"The vehicle stops when the newest frame is older", "s", 0.05, 10.0});
}

template <class Visitor>
void visitProgressOptions(PilotOptions& o, Visitor&& visit) {
  visit("arrival_radius", o.arrival_radius,
        base::OptionInfo{"A waypoint counts as reached this near", "m", 0.05, 100.0}.under(
            "Arrival and progress"));
  visit("home_radius", o.home_radius,
        base::OptionInfo{"The last waypoint counts as reached this near", "m", 0.05, 100.0});
  visit("recover", o.recover,
        base::OptionInfo{"Whether a vehicle that makes no progress looks around and then plans on "
                         "what it has mapped; false: it is stuck after stuck_timeout",
                         ""});
  visit("progress_timeout", o.progress_timeout,
        base::OptionInfo{"Longest time without a metre of progress before it recovers", "s", 0.1,
                         1e6});
  visit("stuck_timeout", o.stuck_timeout,
        base::OptionInfo{"Longest time without a metre of progress where it does not recover", "s",
                         0.1, 1e6});
}

template <class Visitor>
void visitOptions(PilotOptions& o, Visitor&& visit) {
  visitSearchOptions(o, visit);
  visitTreeOptions(o, visit);
  visitVehicleOptions(o, visit);
  visitSensorOptions(o, visit);
  visitProgressOptions(o, visit);
}

// Throws InputError naming the option for a value outside its limits, for a fence or a range whose
// limits are not in order.
void checkPilotOptions(const PilotOptions& options);

}  // namespace grid_path_planner::avoidance
