// What go_to_pose says in /diagnostics.
#include "ros/driving/go_to_pose_node.h"

namespace grid_path_planner::nodes {

using following::NavigatorState;

void GoToPoseNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const bool recovers = navigator_.state() == NavigatorState::RECOVERING;
  const bool alone = goal_ && (!planner_.isThere() || !driver_.isThere());
  status.summary(recovers || alone ? diagnostic_msgs::DiagnosticStatus::WARN
                                   : diagnostic_msgs::DiagnosticStatus::OK,
                 stateName() + ": " + (goal_ ? navigator_.sentence() : last_sentence_));
  status.add("recovery step", navigator_.step());
  status.add("distance remaining (m)", distance_remaining_);
  status.add("time remaining (s)", time_remaining_);
  status.add("planner " + planner_.name(), planner_.isThere() ? "there" : "not there");
  status.add("driver " + driver_.name(), driver_.isThere() ? "there" : "not there");
}

}  // namespace grid_path_planner::nodes
