// Options of the planner inside move_base and Move Base Flex.
#pragma once

#include "grid_path_planner/base/options.h"
#include "planning/cost_planner_options.h"
#include "ros/messages/zero_heading.h"

namespace grid_path_planner::nodes {

struct AdapterOptions {
  planning::CostPlannerOptions planner;
  ZeroHeading zero_heading = ZeroHeading::REFUSED;
  double pose_spacing = -1.0;  // m; -1: a cell of the costmap; 0: corners only
};

template <class Visitor>
void visitOptions(AdapterOptions& o, Visitor&& visit) {
  visitOptions(o.planner, visit);
  visitZeroHeading(o.zero_heading, visit);
  visit("pose_spacing", o.pose_spacing,
        base::OptionInfo{
            "Distance between poses of a plan at most, in equal parts between corners, for "
            "local planners that go from pose to pose, 0.001 m or more; -1: one cell of the "
            "costmap; 0: corners only",
            "m", -1, 10000}
            .under("The plan"));
}

// Throws InputError naming the option for a pose_spacing above 0 and below 0.001 m, of which one plan would take hundreds
// of megabytes, and as checkCostPlannerOptions().
void checkAdapterOptions(const AdapterOptions& options);

}  // namespace grid_path_planner::nodes
