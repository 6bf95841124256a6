// What PlanPanel asks of path_planner.
#include <dynamic_reconfigure/Reconfigure.h>

#include <QFileDialog>
#include <tuple>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/status.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/conversions.h"
#include "panel/path_corners.h"
#include "ros/rviz/plan_panel.h"

namespace grid_path_planner::nodes {

using base::InputError;
using panel::Call;
using panel::cornersOf;
using panel::PlanAnswer;
using panel::PlanFigures;
using panel::PlanRequest;
using panel::RoutePoints;
using panel::Tone;
using path::Path;
using path::Pose;
using path::readWaypointFile;
using path::writeWaypointFile;

namespace {

constexpr double kPatienceOfQuestions = 60.0, kPatienceOfParameters = 10.0;  // s
constexpr char kKindOfFile[] = "Waypoints (*.yaml)";

PlanAnswer answerOf(const PlanStatistics& statistics) {
  PlanAnswer answer;
  answer.status = statistics.status;
  answer.message = statistics.message;
  PlanFigures& figures = answer.figures;
  figures.planner = statistics.answered_by.empty() ? statistics.planner : statistics.answered_by;
  figures.cost = statistics.cost;
  figures.length = statistics.length_m;
  figures.turning = statistics.turning_rad;
  figures.clearance = statistics.clearance_m;
  figures.expanded = static_cast<double>(statistics.expanded);
  figures.time = statistics.planning_time_ms;
  return answer;
}

PlanAnswer answerOf(const PlanPathResult& result) {
  PlanAnswer answer = answerOf(result.statistics);
  answer.status = result.status;
  answer.message = result.message;
  if (!answer.found()) return answer;
  try {
    answer.path = pathFromMessage(result.path);
  } catch (const InputError& error) {
    answer.status = toString(base::Status::INVALID_REQUEST);
    answer.message = std::string("the planner's path cannot be used: ") + error.what();
  }
  return answer;
}

// With a stamp of 0: by the newest transform.
geometry_msgs::PoseStamped newestPose(const std::string& frame, const Pose& pose) {
  geometry_msgs::PoseStamped message;
  message.header.frame_id = frame;
  message.pose = poseToMessage(pose);
  return message;
}

// Start and goal; an empty start is where the vehicle is. Precondition: there is a goal.
std::pair<geometry_msgs::PoseStamped, geometry_msgs::PoseStamped> endsOf(
    const RoutePoints& points) {
  geometry_msgs::PoseStamped start;
  if (points.start()) start = newestPose(points.frame(), *points.start());
  return {start, newestPose(points.frame(), *points.goal())};
}

// "; rectangle_map: INVALID_REQUEST: …", "" where every planner found a path.
std::string firstWithout(const std::vector<PlanStatistics>& results) {
  for (const PlanStatistics& result : results)
    if (base::statusFromName(result.status) != base::Status::FOUND)
      return "; " + result.planner + ": " + result.status + ": " + result.message;
  return "";
}

// Where rviz was started, which roslaunch starts in ~/.ros.
QString folderToBegin() {
  return qEnvironmentVariable("PWD", ".");
}

Path pathOrNothing(const nav_msgs::Path& message) {
  try {
    return pathFromMessage(message);
  } catch (const InputError&) {
    return {};  // its row in the table says that there is a path
  }
}

// Without a suffix rviz's dialog would not find it again.
QString withSuffix(const QString& file) {
  return file.endsWith(".yaml") ? file : file + ".yaml";
}

}  // namespace

void PlanPanel::connectPlans() {
  nodes_->plan.onFeedback = [this](const std::string& id, const PlanPathFeedback& feedback) {
    const auto known = requests_.find(id);
    if (known != requests_.end()) model_.planHeard(known->second, feedback.phase, now());
  };
  nodes_->plan.onResult = [this](const PlanPathActionResult& message) {
    const std::string& id = message.status.goal_id.id;
    const PlanPathResult& result = message.result;
    const auto known = requests_.find(id);
    if (known != requests_.end()) model_.planAnswered(known->second, answerOf(result), now());
  };
}

void PlanPanel::otherPlan(const PlanStatistics& plan) {
  model_.otherPlan(answerOf(plan), now());
}

void PlanPanel::sendPlan(const PlanRequest& request) {
  PlanPathGoal goal;
  const RoutePoints& points = request.points;
  std::tie(goal.start, goal.goal) = endsOf(points);
  for (const Pose& via : points.via()) goal.via_points.push_back(newestPose(points.frame(), via));
  goal.order = request.best_order && points.via().size() > 1 ? "best" : "given";
  requests_ = {{nodes_->plan.send(goal), request.id}};
}

void PlanPanel::compare() {
  if (!model_.buttons().compare) return;
  ComparePlans question;
  std::tie(question.request.start, question.request.goal) = endsOf(model_.points());
  question.request.planners = widgets_.comparison->chosen();
  if (question.request.planners.empty()) {
    model_.say(Tone::BAD, "Tick the planners to be compared in the list below");
    return;
  }
  model_.callBegan(Call::COMPARE);
  calls_.start<ComparePlans>(
      nodes_->nh(), "path_planner/compare_plans", question, kPatienceOfQuestions,
      [this, points = model_.revision()](const ComparePlans& answered) {
        showComparison(answered.response, points);
      },
      [this](const std::string& why) { model_.callEnded(Tone::BAD, why); });
}

void PlanPanel::showComparison(const ComparePlans::Response& response, unsigned points) {
  if (points != model_.revision()) {
    model_.callEnded(Tone::CALM, "The points are others by now: press Compare again");
    return;
  }
  widgets_.comparison->show(response.results);
  compared_.clear();
  const std::size_t count = std::min(response.results.size(), response.paths.size());
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    compared_.push_back({response.results[i].planner, pathOrNothing(response.paths[i])});
    if (base::statusFromName(response.results[i].status) == base::Status::FOUND) ++found;
  }
  draw();
  model_.callEnded(found > 0 ? Tone::GOOD : Tone::BAD,
                   std::to_string(found) + " of " + std::to_string(count) +
                       " planners found a path" + firstWithout(response.results));
}

void PlanPanel::explain() {
  if (!model_.buttons().explain) return;
  ExplainPlan question;
  std::tie(question.request.start, question.request.goal) = endsOf(model_.points());
  model_.callBegan(Call::EXPLAIN);
  calls_.start<ExplainPlan>(
      nodes_->nh(), "path_planner/explain_plan", question, kPatienceOfQuestions,
      [this, points = model_.revision()](const ExplainPlan& answered) {
        showExplanation(answered.response, points);
      },
      [this](const std::string& why) { model_.callEnded(Tone::BAD, why); });
}

void PlanPanel::showExplanation(const ExplainPlan::Response& why, unsigned points) {
  if (points != model_.revision()) {
    model_.callEnded(Tone::CALM, "The points are others by now: press Explain again");
    return;
  }
  explanation_ = explanationMarkers(why, model_.points().frame());
  draw();
  model_.callEnded(base::statusFromName(why.status) == base::Status::FOUND ? Tone::GOOD : Tone::BAD,
                   why.status + ": " + why.message);
}

void PlanPanel::setParameter(const dynamic_reconfigure::Config& change) {
  dynamic_reconfigure::Reconfigure question;
  question.request.config = change;
  parameter_sent_ = now();
  calls_.start<dynamic_reconfigure::Reconfigure>(
      nodes_->nh(), "path_planner/set_parameters", question, kPatienceOfParameters,
      [this](const dynamic_reconfigure::Reconfigure& answered) {
        parameters_->show(answered.response.config);
      },
      [this](const std::string& why) { model_.say(Tone::BAD, why); });
}

void PlanPanel::saveWaypoints() {
  const QString file =
      QFileDialog::getSaveFileName(this, "Waypoint file", folderToBegin() + "/waypoints.yaml",
                                   kKindOfFile, nullptr, QFileDialog::DontUseNativeDialog);
  if (file.isEmpty()) return;
  const std::string name = withSuffix(file).toStdString();
  try {
    const Path corners = cornersOf(model_.path());
    writeWaypointFile(name, corners);
    model_.say(Tone::GOOD, std::to_string(corners.poses.size()) + " waypoints in " + name);
  } catch (const InputError& error) {
    model_.say(Tone::BAD, error.what());
  }
}

void PlanPanel::loadWaypoints() {
  const QString file =
      QFileDialog::getOpenFileName(this, "Waypoint file", folderToBegin(), kKindOfFile, nullptr,
                                   QFileDialog::DontUseNativeDialog);
  if (file.isEmpty()) return;
  try {
    model_.loaded(file.toStdString(), readWaypointFile(file.toStdString()).path);
  } catch (const InputError& error) {
    model_.say(Tone::BAD, error.what());
  }
}

}  // namespace grid_path_planner::nodes
