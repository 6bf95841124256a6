// What PlanPanel asks of navigate_path.
#include "grid_path_planner/ros/conversions.h"
#include "ros/rviz/plan_panel.h"

namespace grid_path_planner::nodes {

using panel::Tone;
using std_srvs::Trigger;

namespace {

constexpr double kPatienceOfDriver = 5.0;  // s

}  // namespace

void PlanPanel::connectDrives() {
  nodes_->drive.onFeedback = [this](const std::string&, const NavigatePathFeedback& feedback) {
    model_.driveHeard(feedback.state, feedback.current_waypoint, feedback.distance_remaining_m,
                      ros::Time::now().toSec());
  };
  nodes_->drive.onResult = [this](const std::string&, const NavigatePathResult& result) {
    model_.driveEnded(result.status, result.message);
  };
}

void PlanPanel::drive() {
  if (!model_.buttons().drive) return;
  NavigatePathGoal goal;
  goal.path = pathToMessage(model_.path(), ros::Time::now());
  nodes_->drive.send(goal);
  model_.driveSent();
}

void PlanPanel::callDriver(const std::string& service) {
  calls_.start<Trigger>(
      nodes_->nh(), "navigate_path/" + service, Trigger(), kPatienceOfDriver,
      [this](const Trigger& answered) {
        model_.say(answered.response.success ? Tone::CALM : Tone::BAD, answered.response.message);
      },
      [this](const std::string& why) { model_.say(Tone::BAD, why); });
}

void PlanPanel::cancel() {
  if (!nodes_) return;
  if (model_.cancelPlan() > 0)
    for (const auto& [id, number] : requests_) nodes_->plan.cancel(id);
  requests_.clear();
  if (nodes_->drive.servers() > 0) callDriver("cancel");
}

}  // namespace grid_path_planner::nodes
