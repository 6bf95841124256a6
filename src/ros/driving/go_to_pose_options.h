// The parameters of the node `go_to_pose`.
#pragma once

#include <string>

#include "following/go_to/navigator_options.h"
#include "ros/messages/zero_heading.h"

namespace grid_path_planner::nodes {

struct GoToPoseOptions {
  std::string action_name = "move_base";
  ZeroHeading zero_heading = ZeroHeading::REFUSED;
  following::NavigatorOptions navigator;
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  double tf_timeout = 2.0;       // s
  double server_timeout = 10.0;  // s, wall time
};

template <class Visitor>
void visitOptions(GoToPoseOptions& o, Visitor&& visit) {
  visit("action_name", o.action_name,
        base::OptionInfo{"Name of the action (move_base_msgs/MoveBaseAction) that clients call; "
                         "read at the start",
                         ""}
            .under("Who asks"));
  visitZeroHeading(o.zero_heading, visit);
  visitOptions(o.navigator, visit);
  visit("map_frame", o.map_frame,
        base::OptionInfo{"Frame of the planner's map, into which goals are transformed once", ""}
            .under("The vehicle's pose"));
  visit("base_frame", o.base_frame,
        base::OptionInfo{"Frame of the vehicle, whose pose tf gives", ""});
  visit("tf_timeout", o.tf_timeout,
        base::OptionInfo{
            "How old a transform of the vehicle or of a goal in another frame may be, "
            "and how long such a goal waits for one, by the wall clock, before it is aborted",
            "s", 0.01, 3600.0});
  visit("server_timeout", o.server_timeout,
        base::OptionInfo{"A planner or driver that has been silent for so long, by the wall clock, "
                         "is taken to be gone; longer than either takes to be started again",
                         "s", 0.5, 3600.0}
            .under("Other nodes"));
}

// Throws InputError naming the option for a value outside its limits, options that checkNavigatorOptions refuses, and
// names that are none.
void checkGoToPoseOptions(const GoToPoseOptions& options);

}  // namespace grid_path_planner::nodes
