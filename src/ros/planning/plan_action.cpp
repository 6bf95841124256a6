#include "ros/planning/plan_action.h"

#include <boost/bind/bind.hpp>
#include <chrono>

#include "grid_path_planner/ros/conversions.h"

namespace grid_path_planner::nodes {

using base::Status;

PlanAction::PlanAction(const ros::NodeHandle& nh, PlanningServer& desk)
    : desk_(desk),
      server_(nh, "plan_path", boost::bind(&PlanAction::execute, this, boost::placeholders::_1),
              false) {
  server_.start();
}

void PlanAction::execute(const PlanPathGoalConstPtr& goal) {
  PlanningRequest question;
  if (!goal->start.header.frame_id.empty()) question.start = goal->start;
  question.goal = goal->goal;
  question.planner = goal->planner;
  const auto inquiry = desk_.ask(question, PlanningServer::Publish::YES);
  if (answeredUncancelled(*inquiry)) {
    finish(inquiry->answer(), goal->goal);
    return;
  }
  PlanningResult cancelled;
  cancelled.report.status = Status::CANCELLED;
  cancelled.report.message = "planning was cancelled";
  cancelled.report.path.frame_id = desk_.settings().options.map_frame;
  cancelled.planner = goal->planner;
  finish(cancelled, goal->goal);
}

// Gives feedback ten times a second until the answer is there or nobody wants it any more.
bool PlanAction::answeredUncancelled(PlanTicket& inquiry) {
  const auto begin = std::chrono::steady_clock::now();
  for (int rounds = 0; !inquiry.waitFor(std::chrono::milliseconds(10)); ++rounds) {
    if (server_.isPreemptRequested()) {
      inquiry.cancel();
      return inquiry.waitFor(std::chrono::milliseconds(50));
    }
    if (rounds % 10 != 0) continue;
    PlanPathFeedback feedback;
    feedback.phase = inquiry.phase();
    feedback.elapsed_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    server_.publishFeedback(feedback);
  }
  return true;
}

void PlanAction::finish(const PlanningResult& answer, const geometry_msgs::PoseStamped& goal) {
  PlanPathResult result;
  const ros::Time now = ros::Time::now();
  result.status = std::string(toString(answer.report.status));
  result.message = answer.report.message;
  result.path = pathToMessage(answer.report.path, now);
  result.statistics = statisticsMessage(answer, goal, now);
  if (answer.found())
    server_.setSucceeded(result, result.message);
  else if (answer.report.status == Status::CANCELLED)
    server_.setPreempted(result, result.message);
  else
    server_.setAborted(result, result.message);
}

}  // namespace grid_path_planner::nodes
