// A plan as a message that says all that repeats it, and back.
//
//   publisher.publish(recordOf(question, map, plan, poses));
//   const PlanQuestion question = questionOf(record);   // equal to that one, to the bit
//
// A pose is written as its numbers: a quaternion does not give a yaw back to the last bit.
#pragma once

#include "grid_path_planner/PlanRecord.h"
#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/planning/path_planner.h"
#include "planning/via/via_plan.h"

namespace grid_path_planner::nodes {

struct PlanQuestion {
  planning::ViaRequest request;
  planning::PlannerOptions options;
  double pose_spacing = -1.0;  // m; -1: a cell of the map
};

// Without stamp, topics, and who asked. `poses`: as they are answered.
PlanRecord recordOf(const PlanQuestion& question, const grid::OccupancyGrid& map,
                    const planning::Plan& plan, const path::Path& poses);

// Throws InputError for options that this version does not have, or lacks, or that cannot be used, and
// for lists of numbers that are no poses.
PlanQuestion questionOf(const PlanRecord& record);

// The path of a plan on a map with poses as pose_spacing asks for them.
path::Path posesAlong(const planning::Plan& plan, const grid::OccupancyGrid& map,
                      double pose_spacing, path::HeadingMode heading);

// Of the package that was compiled.
const char* packageVersion();

}  // namespace grid_path_planner::nodes
