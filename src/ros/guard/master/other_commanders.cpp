#include "ros/guard/master/other_commanders.h"

namespace grid_path_planner::nodes {

using base::StopSource;
using diagnostic_msgs::DiagnosticStatus;

void OtherCommanders::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  asker_.post([this](const StopSource&) { ask(); }, "ask");
  const std::lock_guard<std::mutex> lock(mutex_);
  if (sentence_.empty())
    status.summary(DiagnosticStatus::OK, "nobody else commands the vehicle");
  else
    status.summary(DiagnosticStatus::ERROR, sentence_);
}

void OtherCommanders::ask() {
  const auto other = commands_.other();
  const std::lock_guard<std::mutex> lock(mutex_);
  sentence_ = other ? other->sentence + " too" : "";
}

}  // namespace grid_path_planner::nodes
