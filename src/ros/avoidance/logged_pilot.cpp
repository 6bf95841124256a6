#include "ros/avoidance/logged_pilot.h"

#include <utility>

namespace grid_path_planner::nodes {

using avoidance::MapPlan;
using avoidance::PilotAnswer;
using avoidance::PilotInput;

void LoggedPilot::logTo(const base::OutputFile& file, int megabytes) {
  log_.emplace(file, pilot_.options(), static_cast<std::uint64_t>(megabytes) * 1000000u);
}

void LoggedPilot::setOptions(const avoidance::PilotOptions& options) {
  pilot_.setOptions(options);
  if (log_) log_->options(options);
}

void LoggedPilot::setRoute(const std::vector<Eigen::Vector3d>& points) {
  pilot_.setRoute(points);
  if (log_) log_->route(points);
}

void LoggedPilot::setPath(const std::vector<Eigen::Vector3d>& points) {
  pilot_.setPath(points);
  if (log_) log_->path(points);
}

void LoggedPilot::setMapPlan(const MapPlan& plan) {
  pilot_.setMapPlan([this, plan](const Eigen::Vector3d& from, const Eigen::Vector3d& goal) {
    auto answer = plan(from, goal);
    if (log_ && answer) log_->mapPlan(*answer);
    return answer;
  });
}

void LoggedPilot::cancel(const std::string& reason) {
  pilot_.cancel(reason);
  if (log_) log_->cancel(reason);
}

void LoggedPilot::see(const avoidance::Frame& frame) {
  pilot_.see(frame);
  if (log_) log_->see(frame);
}

PilotAnswer LoggedPilot::update(const PilotInput& input) {
  PilotAnswer answer = pilot_.update(input);
  if (log_) log_->update(input, answer);
  return answer;
}

std::optional<std::string> LoggedPilot::takeLogProblem() {
  if (!log_ || !log_->full() || std::exchange(told_, true)) return std::nullopt;
  return "The flight log ends here: " + log_->problem();
}

}  // namespace grid_path_planner::nodes
