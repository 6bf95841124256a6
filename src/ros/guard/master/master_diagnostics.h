// The master's silence in the diagnostics of a node that drives on without it for a while.
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <sstream>

namespace grid_path_planner::nodes {

constexpr double kMasterIsAsked = 1.0;  // s, how often (master_watch.h)

// Of a master that answered last `silence` seconds ago: after three that it did not answer the summary is a warning, which
// says when the vehicle stands for it. `timeout` in seconds, 0: never.
inline void diagnoseMaster(double silence, double timeout,
                           diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.add("last answer of the master (s ago)", silence);
  if (silence <= 3.0 * kMasterIsAsked) return;
  std::ostringstream text;
  text << status.message << "; the ROS master does not answer: ";
  if (timeout <= 0.0)
    text << "the vehicle drives on";
  else if (silence > timeout)
    text << "the vehicle stands";
  else
    text << "the vehicle stands " << timeout << " s after its last answer";
  using diagnostic_msgs::DiagnosticStatus;
  const bool wrong = status.level == DiagnosticStatus::ERROR;
  status.summary(wrong ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN, text.str());
}

}  // namespace grid_path_planner::nodes
