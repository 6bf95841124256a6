// How an occupancy map becomes costs: the classes of its cells, their weights, the inflation around
// occupied cells, the kernel that downsamples, the steps that are allowed.
#pragma once

#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/costmap/motion_model.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::costmap {

enum class KernelRule { CONSERVATIVE, FILTER2D };
const std::vector<std::pair<const char*, KernelRule>>& choicesOf(KernelRule);

// What lies outside the map is treated like cells of this class.
enum class Outside { FREE, UNKNOWN, OCCUPIED };
const std::vector<std::pair<const char*, Outside>>& choicesOf(Outside);

struct CostmapOptions {
  grid::OccupancyThresholds thresholds;

  int free_weight = 1;
  int unknown_weight = 50;
  int occupied_weight = 100;
  bool unknown_is_passable = true;
  bool occupied_is_passable = false;

  double radius = 0.0;  // m; a cell whose centre is nearer than this to an occupied cell is blocked
  // m, to unknown cells; -1: `radius` where unknown is not passable, else nothing
  double radius_to_unknown = -1.0;
  Outside outside = Outside::UNKNOWN;
  double decay = 0.0;         // 1/m; of the weight beyond the radius; 0: no weight beyond it
  int inflation_weight = 40;  // at the radius

  int kernel = 1;  // cells of a block's side
  KernelRule kernel_rule = KernelRule::CONSERVATIVE;

  MotionModel motion;
};

template <class Visitor>
void visitDistanceOptions(CostmapOptions& o, Visitor&& visit) {
  visit("radius", o.radius,
        base::OptionInfo{
            "Vehicle radius: no point of a path is nearer than this to an occupied cell; set it to "
            "your vehicle's",
            "m", 0, 1000}
            .under("The distance to obstacles"));
  visit("radius_to_unknown", o.radius_to_unknown,
        base::OptionInfo{
            "The same to unknown cells, which are not entered then; -1: radius where unknown is "
            "not passable, else 0",
            "m", -1, 1000});
  visit("outside", o.outside,
        base::OptionInfo{
            "What the map's border is treated as: occupied keeps radius from it, unknown "
            "radius_to_unknown, free nothing",
            ""});
  visit("decay", o.decay,
        base::OptionInfo{
            "How fast the weight falls beyond the radius; 0: no weight beyond the radius; "
            "smaller: wider berth",
            "1/m", 0, 10000});
  visit("inflation_weight", o.inflation_weight,
        base::OptionInfo{
            "Weight at the radius, where decay is not 0; higher: wider berth; keep it under "
            "unknown_weight",
            "", 1, 65535});
}

template <class Visitor>
void visitOptions(CostmapOptions& o, Visitor&& visit) {
  visit("free_max", o.thresholds.free_max,
        base::OptionInfo{"Occupancy up to this is free; lower: more cells count as unknown", "%", 0,
                         99}
            .under("What cells cost"));
  visit("occupied_min", o.thresholds.occupied_min,
        base::OptionInfo{"Occupancy from this on is occupied; lower: more obstacles", "%", 1, 100});
  visit("free_weight", o.free_weight,
        base::OptionInfo{"Cost of a cell length through free cells", "", 1, 65535});
  visit("unknown_weight", o.unknown_weight,
        base::OptionInfo{
            "Cost of a cell length through unknown cells; higher: longer paths around them", "", 1,
            65535});
  visit("occupied_weight", o.occupied_weight,
        base::OptionInfo{"Cost of a cell length through occupied cells, where they are passable",
                         "", 1, 65535});
  visit("unknown_is_passable", o.unknown_is_passable,
        base::OptionInfo{"Whether paths may cross unknown cells; false: never, at any kernel", ""});
  visit("occupied_is_passable", o.occupied_is_passable,
        base::OptionInfo{"Whether paths may cross occupied cells; only for studies, needs radius 0",
                         ""});
  visitDistanceOptions(o, visit);
  visit("kernel", o.kernel,
        base::OptionInfo{
            "Side of the blocks that are searched instead of cells; higher: faster, coarser paths",
            "cells", 1, 1024}
            .under("How the map is searched"));
  visit("kernel_rule", o.kernel_rule,
        base::OptionInfo{
            "How a block is judged: conservative is safe; filter2d is the original study's, "
            "which may overlook obstacles",
            ""});
  visit("connectivity", o.motion.connectivity,
        base::OptionInfo{"Neighbours of a cell: 8 or 4", ""});
  visit("diagonal_cost", o.motion.diagonal_cost,
        base::OptionInfo{"Length of a diagonal step: sqrt2, or unit (1) as in the original study",
                         ""});
  visit("cut_corners", o.motion.cut_corners,
        base::OptionInfo{"Whether a diagonal step may pass a blocked cell's corner", ""});
}

// What paths keep away from with these options.
KeptDistances keptDistances(const CostmapOptions& options);

// Throws InputError naming the option for a value outside its limits and for combinations that
// contradict each other: free_max >= occupied_min, occupied_is_passable with a radius.
void checkCostmapOptions(const CostmapOptions& options);

}  // namespace grid_path_planner::costmap
