#include "ros/planning/plan_diagnostics.h"

#include <optional>
#include <string>

#include "ros/guard/scheduling/guarded_timer.h"

namespace grid_path_planner::nodes {

using base::Status;

using diagnostic_msgs::DiagnosticStatus;

PlanDiagnostics::PlanDiagnostics(ros::NodeHandle nh, ros::NodeHandle private_nh,
                                 PlanningServer& server)
    : server_(server), updater_(nh, private_nh, private_nh.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("map", this, &PlanDiagnostics::reportMap);
  updater_.add("plan", this, &PlanDiagnostics::reportPlan);
  timer_ = guardedTimer(nh, 1.0, [this] {
    if (ros::Time::isValid()) updater_.force_update();
  });
}

void PlanDiagnostics::reportMap(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const ReceivedMap map = server_.maps().latest();
  const double timeout = server_.settings().options.map_data_timeout;
  const std::string refusal = server_.maps().refusal();
  if (!map.grid)
    status.summary(DiagnosticStatus::WARN, "no map has come yet");
  else
    status.summary(DiagnosticStatus::OK, "a map is there");
  const grid::OccupancyThresholds thresholds =
      server_.settings().options.planner.costmap.thresholds;
  if (const std::string problem = map_fit_.problem(map.grid, thresholds); !problem.empty())
    status.summary(DiagnosticStatus::WARN, problem);
  if (const auto old = map.data.problem(Instant::now(), 0.0, timeout))
    status.summary(DiagnosticStatus::WARN,
                   "the map on " + server_.maps().topic() + " is too old: " + *old);
  if (const std::string lost = server_.maps().lost(); !lost.empty())
    status.summary(DiagnosticStatus::WARN, lost);
  if (!refusal.empty())
    status.summary(DiagnosticStatus::ERROR, "the last message was refused: " + refusal);
  if (!map.grid) return;
  status.add("frame", map.frame_id);
  status.add("width", map.grid->width());
  status.add("height", map.grid->height());
  status.add("resolution", map.grid->geometry().resolution());
  status.add("age_s", map.data.newest().isZero() ? secondsBetween(map.stamp, ros::Time::now())
                                                 : map.data.age(Instant::now()));
}

void PlanDiagnostics::reportPlan(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::optional<PlanningServer::Outcome> outcome = server_.lastAnswer()->outcome;
  if (!outcome) {
    status.summary(DiagnosticStatus::OK, "nothing has been asked yet");
    return;
  }
  status.summary(outcome->status == Status::FOUND ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                 std::string(toString(outcome->status)) + ": " + outcome->message);
}

}  // namespace grid_path_planner::nodes
