// /diagnostics once a second of the wall clock, whatever ROS time does.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include "ros/guard/scheduling/guarded_timer.h"

namespace grid_path_planner::nodes {

constexpr double kDiagnosisPeriod = 1.0;  // s, wall time

// `updater` outlives the timer.
inline ros::SteadyTimer diagnosticsTimer(ros::NodeHandle& nh,
                                         diagnostic_updater::Updater& updater) {
  updater.setHardwareID("none");
  return guardedTimer(nh, kDiagnosisPeriod, [&updater] {
    if (ros::Time::isValid()) updater.force_update();
  });
}

}  // namespace grid_path_planner::nodes
