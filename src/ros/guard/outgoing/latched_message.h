// Drops what a publisher has latched.
//
//   ros::Publisher maps;
//   forgetLatched(maps);
//
// Who subscribes from now on gets nothing until something is published again; whoever has subscribed stays. roscpp offers
// only to give the topic up and to advertise it again, which asks the master, loses its subscribers for a moment, and
// is not safe beside other threads (topic_changes.h).
#pragma once

#include <ros/publisher.h>

namespace grid_path_planner::nodes {

void forgetLatched(const ros::Publisher& publisher);

}  // namespace grid_path_planner::nodes
