// What PlanPanel asks of navigate_path.
#include <utility>

#include "grid_path_planner/ros/conversions.h"
#include "ros/rviz/plan_panel.h"

namespace grid_path_planner::nodes {

using panel::Tone;
using std_srvs::Trigger;

namespace {

constexpr double kPatienceOfDriver = 5.0;  // s

}  // namespace

void PlanPanel::connectDrives() {
  nodes_->drive.onFeedback = [this](const std::string& id, const NavigatePathFeedback& heard) {
    model_.driveHeard(
        id,
        {heard.state, heard.current_waypoint, heard.distance_remaining_m, ros::Time::now().toSec()},
        now());
  };
  nodes_->drive.onResult = [this](const NavigatePathActionResult& message) {
    const std::string& id = message.status.goal_id.id;
    if (id == drive_) drive_.clear();
    const bool arrived = message.status.status == actionlib_msgs::GoalStatus::SUCCEEDED;
    model_.driveEnded(id, arrived, message.result.status, message.result.message);
  };
}

void PlanPanel::drive() {
  if (!model_.buttons().drive) return;
  NavigatePathGoal goal;
  goal.path = pathToMessage(model_.path(), ros::Time::now());
  drive_ = nodes_->drive.send(goal);
  model_.driveSent(drive_, now());
}

void PlanPanel::callDriver(const std::string& service) {
  askDriver(service, [this](const Trigger& answered) {
    model_.say(answered.response.success ? Tone::CALM : Tone::BAD, answered.response.message);
  });
}

void PlanPanel::askDriver(const std::string& service,
                          std::function<void(const Trigger&)> answered) {
  calls_.start<Trigger>(nodes_->nh(), "navigate_path/" + service, Trigger(), kPatienceOfDriver,
                        std::move(answered),
                        [this](const std::string& why) { model_.say(Tone::BAD, why); });
}

void PlanPanel::cancelPlans() {
  if (model_.cancelPlan() > 0)
    for (const auto& [id, number] : requests_) nodes_->plan.cancel(id);
  requests_.clear();
}

void PlanPanel::cancelDrives() {
  if (nodes_->drive.servers() == 0) return;
  const std::string own = drive_;
  // A service is looked up at the master, which may be gone; the topic is connected. Without an id: all goals.
  nodes_->drive.cancel(own);
  askDriver("cancel", [this, own](const Trigger& answered) {
    // The result of the panel's own drive says more than that nothing is driven any more.
    if (own.empty() || !answered.response.success)
      model_.say(answered.response.success ? Tone::CALM : Tone::BAD, answered.response.message);
  });
}

void PlanPanel::cancel() {
  if (!nodes_) return;
  cancelPlans();
  cancelDrives();
}

}  // namespace grid_path_planner::nodes
