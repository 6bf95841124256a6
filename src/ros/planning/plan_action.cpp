#include "ros/planning/plan_action.h"

#include <boost/bind/bind.hpp>
#include <chrono>

#include "base/current_error.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/common/action/action_topics.h"
#include "ros/common/guarded_queue.h"
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

PlanAction::PlanAction(const ros::NodeHandle& nh, PlanningServer& server)
    : server_(server),
      action_(nh, "plan_path", boost::bind(&PlanAction::execute, this, boost::placeholders::_1),
              false) {
  action_.start();
}

// actionlib calls it in a thread of its own, which no exception may leave.
void PlanAction::execute(const PlanPathGoalConstPtr& goal) {
  try {
    answer(*goal);
  } catch (...) {
    tryToGiveUp();
  }
}

// In a catch block. Where there is no memory for this either, actionlib aborts the goal that has no end.
void PlanAction::tryToGiveUp() noexcept {
  try {
    PlanPathResult result;
    result.status = std::string(toString(Status::INVALID_REQUEST));
    result.message = "the request was given up: " + currentErrorText();
    action_.setAborted(result, result.message);
  } catch (...) {
    tellGivenUp("The answer to a goal of plan_path");
  }
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
    feedback.elapsed_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
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
