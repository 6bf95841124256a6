// What local_planner says in /diagnostics.
#include "ros/avoidance/local_planner_node.h"
#include "ros/guard/master/master_diagnostics.h"
#include "ros/guard/scheduling/guarded_timer.h"

namespace grid_path_planner::nodes {

using avoidance::PilotStatus;
using diagnostic_msgs::DiagnosticStatus;

namespace {

constexpr double kDiagnosed = 1.0;  // s, wall time

}  // namespace

void LocalPlannerNode::startDiagnostics() {
  diagnostics_.setHardwareID("none");
  diagnostics_.add("flight", this, &LocalPlannerNode::diagnose);
  diagnostics_.add("other nodes", &others_, &OtherCommanders::report);
  // force_update: the updater's own clock is ROS time, which may jump back.
  diagnostics_timer_ = guardedTimer(nh_, kDiagnosed, [this] { diagnostics_.force_update(); });
}

void LocalPlannerNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const bool well = answer_.status == PilotStatus::IDLE || answer_.status == PilotStatus::FLYING ||
                    answer_.status == PilotStatus::ARRIVED ||
                    answer_.status == PilotStatus::CANCELLED;
  status.summary(well ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                 std::string(toString(answer_.status)) + ": " + answer_.sentence);
  status.add("newest cloud (s old)", answer_.frame_age);
  status.add("nearest point (m)", answer_.clearance);
  status.add("open path (m)", answer_.clear_path);
  clouds_.addTo(status);
  status.add("braked for want of a newer plan", commander_.overdue());
  status.add("refused messages on stop and manual_control", commander_.refused());
  status.add("scheduling of commands", commander_.gate().scheduling());
  diagnoseMaster(commander_.gate().masterSilence(), options_.master_timeout, status);
}

}  // namespace grid_path_planner::nodes
