#include "ros/planning/planning_server.h"

#include <ros/console.h>

#include <chrono>
#include <limits>
#include <utility>

#include "base/current_error.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "planning/map_store.h"
#include "ros/messages/file_kinds.h"
#include "ros/planning/requests/request_poses.h"
#include "vehicle/footprint.h"

namespace grid_path_planner::nodes {

using base::currentErrorText;
using base::InputError;
using base::Status;
using base::Stopped;
using base::StopSource;
using base::StopToken;
using path::measuresText;
using path::writeWaypointFile;
using planning::failedPlan;
using planning::MapStore;
using planning::Plan;
using vehicle::Footprint;

namespace {

// How long an explanation may take where it was asked for, and where an answer waits for it.
constexpr std::chrono::milliseconds kExplains(1000), kExplainsAtOnce(300);

Placing atOnce(Placing by) {
  by.wait = 0.0;
  return by;
}

}  // namespace

PlanningServer::PlanningServer(ros::NodeHandle nh, const PathPlannerNodeOptions& options,
                               const NodeFiles& files)
    : files_(files),
      settings_(Settings{options, 0}),
      transforms_(nh),
      publisher_(nh),
      recorder_(nh),
      explanations_(nh),
      store_(std::make_shared<MapStore>()) {}

void PlanningServer::setOptions(const PathPlannerNodeOptions& options) {
  settings_.change([&](Settings& next) { next = {options, next.revision + 1}; });
}

bool PlanTicket::waitForPoses(std::chrono::duration<double> limit) const {
  std::unique_lock<std::mutex> lock(mutex_);
  if (told_.wait_for(lock, limit, [this] { return has_poses_; })) return true;
  return task_->waitFor(std::chrono::duration<double>(0.0));
}

void PlanTicket::tellPoses() {
  const std::lock_guard<std::mutex> lock(mutex_);
  has_poses_ = true;
  told_.notify_all();
}

std::shared_ptr<PlanTicket> PlanningServer::ask(const PlanningRequest& request, Publish publish,
                                                Explain explain) {
  auto ticket = std::make_shared<PlanTicket>();
  asked_ = true;
  ticket->map_ = store_->revision();
  ticket->task_ = question_lane_.worker().post(
      [this, ticket, request, publish, explain](const StopSource& stop) {
        answer(*ticket, request, publish, explain, stop);
        question_lane_.finishLater(settings().options);
      });
  return ticket;
}

void PlanningServer::startMaps(ros::NodeHandle nh, std::function<void()> on_map) {
  maps_.start(std::move(nh), [this, on_map = std::move(on_map)](const MapChange& change) {
    storeMap(change);
    on_map();
  });
}

void PlanningServer::storeMap(const MapChange& change) {
  const bool whole = std::exchange(store_is_behind_, true) || !change.changed;
  if (whole)
    store_->setMap(change.map.grid, change.map.frame_id);
  else if (!change.changed->empty())
    store_->updateMap(change.map.grid, *change.changed);
  store_is_behind_ = false;
}

void PlanningServer::prepareForQuestions() {
  question_lane_.worker().post(
      [this](const StopSource& stop) {
        if (!asked_.exchange(false)) return question_lane_.takeMap();
        const PathPlannerNodeOptions options = settings().options;
        try {
          question_lane_.prepare(options, stop.token());
        } catch (const Stopped&) {
          return;  // the node ends
        }
        question_lane_.finishLater(options);
      },
      "map");
}

void PlanningServer::answer(PlanTicket& ticket, const PlanningRequest& request, Publish publish,
                            Explain explain, const StopSource& stop) {
  PathPlannerNodeOptions options = recordingOptions(settings().options);
  if (publish == Publish::NO) options.record_search = false;
  tellJumps();
  ticket.via_ = question_lane_.plan(
      request, options, stop, [&](const char* phase) { ticket.phase_ = phase; }, ticket.map_);
  Plan plan = std::move(ticket.via_.plan);
  try {
    // A record names the map that was searched, and what explains a plan takes a newer one. Who waits for
    // poses does not wait for a record.
    if (!plan.found()) record(question_lane_, plan, options);
    if (publish == Publish::YES || explain == Explain::YES) {
      ticket.explanation_ =
          question_lane_.explain(request, plan.status, options, stop,
                                 explain == Explain::YES ? kExplains : kExplainsAtOnce);
      if (!ticket.explanation_.text.empty()) plan.message += "; " + ticket.explanation_.text;
    }
    ticket.poses_ = question_lane_.posesAlong(plan, options);
    const bool published = publish == Publish::YES && !stop.cancelled();
    if (published) remember(plan);
    ticket.tellPoses();
    if (plan.found()) record(question_lane_, plan, options);
    ticket.statistics_ = question_lane_.statistics(plan, request, options);
    ticket.plan_ = std::move(plan);
    if (published) this->publish(question_lane_, ticket.plan_, ticket.statistics_);
  } catch (...) {
    ticket.plan_ =
        failedPlan(Status::INVALID_REQUEST, "the request was given up: " + currentErrorText());
    ticket.statistics_ = statisticsMessage(ticket.plan_);
    ticket.tellPoses();
  }
}

void PlanningServer::explainLater(const PlanningRequest& request, const Plan& plan) {
  std::unique_lock<std::mutex> lock(explanation_mutex_);
  const unsigned number = ++explanation_number_;
  if (plan.found()) return explanations_.clear();
  lock.unlock();
  question_lane_.worker().post(
      [this, request, plan, number](const StopSource& stop) {
        explain(request, plan, number, stop);
        question_lane_.finishLater(settings().options);
      },
      "explanation");
}

void PlanningServer::explain(const PlanningRequest& request, const Plan& plan, unsigned number,
                             const StopSource& stop) {
  const planning::Explanation explanation =
      question_lane_.explain(request, plan.status, settings().options, stop, kExplains);
  const std::lock_guard<std::mutex> shown(explanation_mutex_);
  if (number != explanation_number_) return;  // of a plan that another one has followed
  if (explanation.text.empty() || stop.cancelled()) return explanations_.clear();
  const std::string message = plan.message + "; " + explanation.text;
  ROS_WARN_STREAM("Why: " << message);
  explanations_.publish(explanation, plan.path.frame_id);
  answered_.change([&](Answered& next) {
    if (next.outcome && next.outcome->message == plan.message) next.outcome->message = message;
  });
}

PathPlannerNodeOptions PlanningServer::recordingOptions(PathPlannerNodeOptions options) const {
  options.record_search = options.record_search && publisher_.searchIsShown();
  return options;
}

// What of a path lies behind it was driven, however long ago.
std::optional<Eigen::Vector2d> PlanningServer::vehicle(
    const std::string& frame, const PathPlannerNodeOptions& options) const {
  Placing by = atOnce(placingInMap(options, frame));
  by.max_age = std::numeric_limits<double>::infinity();
  try {
    return transforms_.placeVehicle(by).level().position.head<2>();
  } catch (const TransformError&) {
    return std::nullopt;
  }
}

bool PlanningServer::placed(const std::string& frame,
                            const geometry_msgs::PoseStamped& goal) const {
  const PathPlannerNodeOptions options = settings().options;
  try {
    const Placing by = atOnce(placingInMap(options, frame));
    transforms_.placeVehicle(by);
    transforms_.place(goal, by);
    return true;
  } catch (const TransformError&) {
  } catch (const InputError&) {
  }
  return false;
}

void PlanningServer::stop() {
  maps_.shutdown();
  vehicle_lane_.worker().stop();
  question_lane_.worker().stop();
}

void PlanningServer::record(const PlanningLane& lane, const Plan& plan,
                            const PathPlannerNodeOptions& options) const {
  if (!recorder_.wanted()) return;
  const bool question = &lane == &question_lane_;
  if (auto message = lane.record(plan, options))
    recorder_.publish(*std::move(message),
                      question ? PlanRecorder::Asked::BY_QUESTION : PlanRecorder::Asked::BY_GOAL);
}

void PlanningServer::publish(const PlanningLane& lane, const Plan& plan,
                             const PlanStatistics& statistics, bool as_before) {
  if (plan.found())
    ROS_INFO_STREAM("FOUND: " << plan.message << "; "
                              << measuresText(statistics.clearance_m, statistics.turning_rad));
  else if (!as_before)
    ROS_WARN_STREAM(toString(plan.status) << ": " << plan.message);
  const PathPlannerNodeOptions options = settings().options;
  const bool placed = vehicle(lane.frame(options), options).has_value();
  ShownPlan shown{plan, statistics, lane.cellSize(plan), 0.0, options.base_frame};
  shown.map_side = lane.mapSide();
  if (placed) {
    shown.radius = options.planner.costmap.radius;
    shown.footprint = Footprint::fromText("footprint", options.planner.footprint).corners();
  }
  publisher_.publishSearch(shown);
  if (plan.found()) writeWaypoints();
}

void PlanningServer::remember(const Plan& plan) {
  answered_.change([&](Answered& next) {
    next.outcome = Outcome{plan.status, plan.message};
    if (plan.found()) next.waypoints = plan.waypoints;
  });
}

// Both lanes write. Whichever comes last writes what lastAnswer() tells, so that the file agrees with it.
void PlanningServer::writeWaypoints() {
  const std::string file = settings().options.waypoints_file;
  if (file.empty()) return;
  const std::lock_guard<std::mutex> lock(writing_mutex_);
  const std::shared_ptr<const Answered> answered = lastAnswer();
  if (!answered->waypoints) return;
  try {
    writeWaypointFile(files_.toWrite("waypoints_file", file, waypointFiles()),
                      *answered->waypoints);
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("The waypoints were not saved: " << error.what());
  }
}

}  // namespace grid_path_planner::nodes
