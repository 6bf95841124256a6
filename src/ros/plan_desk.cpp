#include "grid_path_planner/ros/plan_desk.h"

#include <ros/console.h>

#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/waypoint_file.h"

namespace grid_path_planner {

PlanDesk::PlanDesk(ros::NodeHandle nh, const PathPlannerNodeOptions& options,
                   std::function<void()> on_time_jump)
    : on_time_jump_(std::move(on_time_jump)),
      settings_{options, 0},
      transforms_(nh),
      publisher_(nh),
      engine_(maps_, transforms_) {}

PlanDesk::Settings PlanDesk::settings() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return settings_;
}

void PlanDesk::setOptions(const PathPlannerNodeOptions& options) {
  std::lock_guard<std::mutex> lock(mutex_);
  settings_ = {options, settings_.revision + 1};
}

std::shared_ptr<Inquiry> PlanDesk::ask(const PlanQuestion& question, Announce announce) {
  auto inquiry = std::make_shared<Inquiry>();
  inquiry->task_ = worker_.post([this, inquiry, question, announce](const StopSource& stop) {
    const auto on_phase = [&](PlanEngine::Phase phase) {
      inquiry->phase_ = phase == PlanEngine::Phase::PREPARING ? "preparing" : "searching";
    };
    inquiry->answer_ = answer(question, settings().options, stop, on_phase);
    if (announce == Announce::YES && !stop.cancelled())
      this->announce(inquiry->answer_, question.goal);
  });
  return inquiry;
}

PlanAnswer PlanDesk::answer(const PlanQuestion& question, const PathPlannerNodeOptions& options,
                            const StopSource& stop, const PlanEngine::PhaseListener& on_phase) {
  checkClock();
  return engine_.answer(question, options, stop, on_phase);
}

void PlanDesk::checkClock() {
  if (!clock_.jumpedBack()) return;
  ROS_WARN("ROS time jumped back: transforms and start poses from before are forgotten");
  transforms_.clear();
  on_time_jump_();
}

void PlanDesk::stop() {
  maps_.shutdown();
  worker_.stop();
}

void PlanDesk::announce(const PlanAnswer& answer, const geometry_msgs::PoseStamped& goal) {
  const PlanReport& report = answer.report;
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

void PlanDesk::writeWaypoints(const Path& path) {
  const std::string file = settings().options.waypoints_file;
  if (file.empty()) return;
  try {
    writeWaypointFile(file, path);
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("The waypoints were not saved: " << error.what());
  }
}

std::optional<PlanDesk::Outcome> PlanDesk::lastOutcome() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return outcome_;
}

std::optional<Path> PlanDesk::lastPath() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return last_path_;
}

}  // namespace grid_path_planner
