#include "ros/planning/planning_server.h"

#include <ros/console.h>

#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/waypoint_file.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::StopSource;
using path::Path;
using path::writeWaypointFile;
using planning::Plan;

PlanningServer::PlanningServer(ros::NodeHandle nh, const PathPlannerNodeOptions& options,
                               std::function<void()> on_time_jump)
    : on_time_jump_(std::move(on_time_jump)),
      settings_{options, 0},
      transforms_(nh),
      publisher_(nh),
      engine_(maps_, transforms_) {}

PlanningServer::Settings PlanningServer::settings() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return settings_;
}

void PlanningServer::setOptions(const PathPlannerNodeOptions& options) {
  std::lock_guard<std::mutex> lock(mutex_);
  settings_ = {options, settings_.revision + 1};
}

std::shared_ptr<PlanTicket> PlanningServer::ask(const PlanningRequest& question, Publish announce) {
  auto inquiry = std::make_shared<PlanTicket>();
  inquiry->task_ = worker_.post([this, inquiry, question, announce](const StopSource& stop) {
    const auto on_phase = [&](PlanningBackend::Phase phase) {
      inquiry->phase_ = phase == PlanningBackend::Phase::PREPARING ? "preparing" : "searching";
    };
    inquiry->answer_ = answer(question, settings().options, stop, on_phase);
    if (announce == Publish::YES && !stop.cancelled())
      this->publish(inquiry->answer_, question.goal);
  });
  return inquiry;
}

PlanningResult PlanningServer::answer(const PlanningRequest& question,
                                      const PathPlannerNodeOptions& options, const StopSource& stop,
                                      const PlanningBackend::PhaseListener& on_phase) {
  checkClock();
  return engine_.answer(question, options, stop, on_phase);
}

void PlanningServer::checkClock() {
  if (!clock_.jumpedBack()) return;
  ROS_WARN("ROS time jumped back: transforms and start poses from before are forgotten");
  transforms_.clear();
  on_time_jump_();
}

void PlanningServer::stop() {
  maps_.shutdown();
  worker_.stop();
}

void PlanningServer::publish(const PlanningResult& answer, const geometry_msgs::PoseStamped& goal) {
  const Plan& report = answer.report;
  if (answer.found())
    ROS_INFO_STREAM("FOUND: " << report.message);
  else
    ROS_WARN_STREAM(toString(report.status) << ": " << report.message);
  publisher_.publishSearch(answer, goal,
                           engine_.hasMap() ? engine_.resolution() * report.kernel : 1.0);
  if (answer.found()) writeWaypoints(report.path);
  std::lock_guard<std::mutex> lock(mutex_);
  outcome_ = Outcome{report.status, report.message};
  if (answer.found()) last_path_ = report.path;
}

void PlanningServer::writeWaypoints(const Path& path) {
  const std::string file = settings().options.waypoints_file;
  if (file.empty()) return;
  try {
    writeWaypointFile(file, path);
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("The waypoints were not saved: " << error.what());
  }
}

std::optional<PlanningServer::Outcome> PlanningServer::lastOutcome() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return outcome_;
}

std::optional<Path> PlanningServer::lastPath() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return last_path_;
}

}  // namespace grid_path_planner::nodes
