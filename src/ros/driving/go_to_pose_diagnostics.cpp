// What go_to_pose says in /diagnostics, as feedback and on go_to_status.
#include <cmath>

#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/driving/go_to_pose_node.h"
#include "ros/guard/outgoing/latched_message.h"

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

void GoToPoseNode::publishFeedback(const ros::Time& now) {
  if (!vehicle_) return;
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position.header.stamp = now;
  feedback.base_position.header.frame_id = frameName(options_.map_frame);
  feedback.base_position.pose = poseToMessage(*vehicle_);
  goal_->handle.publishFeedback(feedback);
}

void GoToPoseNode::publishStatus() {
  if (ros::Time::isValid()) publishLatched(status_publisher_, status());
}

std::string GoToPoseNode::stateName() const {
  return goal_ && !goal_->pose ? "LOCATING" : toString(navigator_.state());
}

GoToStatus GoToPoseNode::status() const {
  GoToStatus status;
  status.header.stamp = ros::Time::now();
  status.header.frame_id = frameName(options_.map_frame);
  status.state = stateName();
  status.step = navigator_.step();
  status.sentence = goal_ ? navigator_.sentence() : last_sentence_;
  status.goal = last_pose_;
  status.distance_remaining_m = distance_remaining_;
  status.time_remaining_s = time_remaining_;
  if (std::isfinite(time_remaining_) && time_remaining_ >= 0.0 && time_remaining_ < 1e6)
    status.arrival = status.header.stamp + ros::Duration(time_remaining_);
  return status;
}

}  // namespace grid_path_planner::nodes
