#include "ros/planning/plan_action.h"

#include <chrono>

#include "base/current_error.h"
#include "base/seconds_since.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/guard/action/action_topics.h"
#include "ros/guard/guarded_queue.h"
#include "ros/planning/requests/request_messages.h"

namespace actionlib {

template <>
void ActionServer<grid_path_planner::PlanPathAction>::initialize() {
  grid_path_planner::nodes::openActionTopics(
      *this, node_,
      {goal_sub_, cancel_sub_, result_pub_, feedback_pub_, status_pub_, status_timer_,
       status_list_timeout_, status_list_, lock_},
      [this](const ros::TimerEvent&) { publishStatus(); });
}

}  // namespace actionlib

namespace grid_path_planner::nodes {

using base::currentErrorText;
using base::Status;
using path::Path;
using planning::failedPlan;
using planning::Plan;
using planning::ViaPlan;

namespace {

constexpr double kRetryPeriod = 0.1;  // s, after which what failed with a goal is tried again

}  // namespace

PlanAction::PlanAction(const ros::NodeHandle& nh, PlanningServer& server)
    : server_(server), action_(nh, "plan_path", false) {
  action_.registerGoalCallback([this] { onGoal(); });
  action_.start();
  thread_ = std::thread([this] { run(); });
}

PlanAction::~PlanAction() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

// Wants no memory: a goal that waits is never lost.
void PlanAction::onGoal() {
  const std::lock_guard<std::mutex> lock(mutex_);
  goal_came_ = true;
  changed_.notify_all();
}

// Not in the thread that actionlib has for this, which an exception would leave: it throws where a goal is taken while
// /clock is at the end of what a time can hold.
void PlanAction::run() {
  while (waitForGoal()) guarded("A goal of plan_path", [this] { answerNext(); });
}

bool PlanAction::waitForGoal() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return ends_ || goal_came_; });
  goal_came_ = false;
  return !ends_;
}

bool PlanAction::endsWithin(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return ends_; });
}

void PlanAction::answerNext() {
  try {
    if (action_.isNewGoalAvailable()) answer(*action_.acceptNewGoal());
  } catch (...) {
    giveUp(currentErrorText());
    if (!endsWithin(kRetryPeriod)) onGoal();  // one that could not be taken waits still
  }
}

// Of the goal that is active.
void PlanAction::giveUp(const std::string& error) {
  if (!action_.isActive()) return;
  PlanPathResult result;
  result.status = std::string(toString(Status::INVALID_REQUEST));
  result.message = "the request was given up: " + error;
  action_.setAborted(result, result.message);
}

void PlanAction::answer(const PlanPathGoal& goal) {
  const PlanningRequest request = requestOf(goal);
  const auto ticket = server_.ask(request, PlanningServer::Publish::YES);
  if (answeredUncancelled(*ticket)) {
    finish(ticket->plan(), ticket->poses(), ticket->statistics(), ticket->via());
    return;
  }
  Plan cancelled = failedPlan(Status::CANCELLED, "planning was cancelled");
  cancelled.path.frame_id = server_.settings().options.map_frame;
  PlanStatistics statistics = statisticsMessage(cancelled);
  const PlanningRequest asked = printable(request);
  statistics.goal = asked.goal;
  statistics.planner = asked.planner;
  finish(cancelled, cancelled.path, statistics, {});
}

// Gives feedback ten times a second until the answer is there or the goal is cancelled.
bool PlanAction::answeredUncancelled(PlanTicket& ticket) {
  const auto begin = std::chrono::steady_clock::now();
  for (int rounds = 0; !ticket.waitFor(std::chrono::milliseconds(10)); ++rounds) {
    if (action_.isPreemptRequested()) {
      ticket.cancel();
      return ticket.waitFor(std::chrono::milliseconds(50));
    }
    if (rounds % 10 != 0) continue;
    PlanPathFeedback feedback;
    feedback.phase = ticket.phase();
    feedback.elapsed_s = base::secondsSince(begin);
    action_.publishFeedback(feedback);
  }
  return true;
}

void PlanAction::finish(const Plan& plan, const Path& poses, const PlanStatistics& statistics,
                        const ViaPlan& via) {
  PlanPathResult result;
  const ros::Time now = ros::Time::now();
  result.status = std::string(toString(plan.status));
  result.message = plan.message;
  result.path = pathToMessage(poses, now);
  result.statistics = statistics;
  result.statistics.header.stamp = now;
  result.order.assign(via.order.begin(), via.order.end());
  result.order_exact = via.order_exact;
  result.unreachable.assign(via.unreachable.begin(), via.unreachable.end());
  if (plan.found())
    action_.setSucceeded(result, result.message);
  else if (plan.status == Status::CANCELLED)
    action_.setPreempted(result, result.message);
  else
    action_.setAborted(result, result.message);
}

}  // namespace grid_path_planner::nodes
