#include "ros/guard/outgoing/refused_parameter.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <std_msgs/String.h>

#include "ros/guard/outgoing/latched_message.h"
#include "ros/guard/scheduling/guarded_timer.h"

namespace grid_path_planner::nodes {

RefusedParameter::RefusedParameter(const ros::NodeHandle& private_nh)
    : private_nh_(private_nh),
      publisher_(private_nh_.advertise<std_msgs::String>("parameter_refused", 1, true)),
      diagnostics_(private_nh_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1)) {}

void RefusedParameter::refuse(const std::string& sentence) {
  tell(sentence);
  if (timer_) return;
  timer_ = guardedTimer(private_nh_, 1.0, [this] { publishDiagnostics(); });
}

void RefusedParameter::accept() {
  if (!sentence_.empty()) tell("");
}

void RefusedParameter::tell(const std::string& sentence) {
  sentence_ = sentence;
  std_msgs::String message;
  message.data = sentence;
  publishLatched(publisher_, message);
}

void RefusedParameter::publishDiagnostics() {
  if (!ros::Time::isValid()) return;
  diagnostic_msgs::DiagnosticStatus status;
  const std::string node = private_nh_.getNamespace();
  status.name = node.substr(1) + ": parameters";
  status.hardware_id = "none";
  if (sentence_.empty()) {
    status.message = "the last change was taken";
  } else {
    status.level = diagnostic_msgs::DiagnosticStatus::WARN;
    status.message = "the last change was refused, the old values stay: " + sentence_;
  }
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = ros::Time::now();
  message.status.push_back(status);
  diagnostics_.publish(message);
}

}  // namespace grid_path_planner::nodes
