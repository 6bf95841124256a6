#include "ros/avoidance/flight_action.h"

#include <ros/callback_queue_interface.h>
#include <ros/console.h>

#include <cmath>
#include <limits>
#include <utility>

#include "base/current_error.h"
#include "grid_path_planner/base/errors.h"
#include "ros/guard/guarded_queue.h"
#include "ros/messages/waypoint_reading.h"

namespace grid_path_planner::nodes {

using avoidance::PilotAnswer;
using avoidance::PilotStatus;
using avoidance::VehiclePose;
using base::StopSource;
using path::Path;

namespace {

constexpr double kFeedbackEvery = 0.2;  // s, wall time

bool hasEnded(PilotStatus status) {
  return status == PilotStatus::ARRIVED || status == PilotStatus::STUCK ||
         status == PilotStatus::CANCELLED;
}

}  // namespace

FlightAction::FlightAction(const ros::NodeHandle& nh, const NodeFiles& files, Callbacks callbacks)
    : nh_(nh),
      files_(files),
      callbacks_(std::move(callbacks)),
      server_(nh_, "navigate_path", false),
      reader_([](const std::string& error) { tellGivenUp("A waypoint file", error); }) {
  server_.registerGoalCallback([this] { onGoal(); });
  server_.registerPreemptCallback([this] { onPreempt(); });
  server_.start();
}

FlightAction::~FlightAction() {
  reader_.stop();
  nh_.getCallbackQueue()->removeByID(reinterpret_cast<std::uint64_t>(this));
  if (active_) finish(PilotStatus::CANCELLED, "local_planner ends");
}

void FlightAction::onGoal() {
  if (active_) {
    callbacks_.cancel("replaced by another goal");  // whatever becomes of that
    finish(PilotStatus::CANCELLED, "replaced by another goal");
  }
  const auto goal = server_.acceptNewGoal();
  active_ = true;
  is_read_ = false;
  ++goals_;
  const bool has_path = !goal->path.poses.empty(), has_file = !goal->filename.empty();
  if (has_file && !has_path) return readFile(goal->filename);
  start(
      [&] {
        if (has_file || !has_path)
          throw base::InputError("a goal must give a path of at least one waypoint or a filename");
        return callbacks_.read(goal->path);
      },
      true, callbacks_.handovers());
}

void FlightAction::onPreempt() {
  if (server_.isNewGoalAvailable() || !active_) return;
  callbacks_.cancel("the goal of the action was cancelled");
  cancelReading("cancelled while its file was read");
}

bool FlightAction::cancelReading(const std::string& reason) {
  if (!active_ || !std::exchange(is_read_, false)) return false;
  finish(PilotStatus::CANCELLED, reason);
  return true;
}

// In the reader's thread, and back.
void FlightAction::readFile(const std::string& filename) {
  is_read_ = true;
  reader_.post([this, filename, number = goals_,
                handovers = callbacks_.handovers()](const StopSource& stop) {
    std::function<Path()> result;
    try {
      result = [found = readWaypoints(files_, filename, stop)] { return found; };
    } catch (const std::exception& error) {
      result = [what = std::string(error.what())]() -> Path { throw base::InputError(what); };
    }
    const auto use = [this, result, number, handovers] {
      if (active_ && number == goals_ && std::exchange(is_read_, false))
        start(result, false, handovers);
    };
    nh_.getCallbackQueue()->addCallback(callbackOf(use), reinterpret_cast<std::uint64_t>(this));
  });
}

void FlightAction::start(const std::function<Path()>& read, bool along, unsigned handovers) {
  try {
    flown_ = callbacks_.fly(read(), along, handovers);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_STREAM("The goal of the action is refused: " << error.what());
    refuse(error.what());
  } catch (...) {
    refuse("the goal was given up: " + base::currentErrorText());
  }
}

void FlightAction::report(const PilotAnswer& answer, const VehiclePose& at) {
  at_ = at;
  if (!active_ || is_read_) return;
  if (hasEnded(answer.status)) return finish(answer.status, answer.sentence);
  const auto now = ros::SteadyTime::now();
  if ((now - told_).toSec() < kFeedbackEvery) return;
  told_ = now;
  giveFeedback(answer);
}

void FlightAction::giveFeedback(const PilotAnswer& answer) {
  NavigatePathFeedback feedback;
  feedback.current_waypoint = static_cast<std::uint32_t>(answer.waypoint);
  feedback.distance_remaining_m = remaining(static_cast<std::size_t>(answer.waypoint));
  feedback.time_remaining_s = std::numeric_limits<double>::infinity();
  feedback.state = toString(answer.status);
  server_.publishFeedback(feedback);
}

// In straight lines through the waypoints that are left.
double FlightAction::remaining(std::size_t waypoint) const {
  double length = 0.0;
  Eigen::Vector3d from = at_.position;
  for (std::size_t i = waypoint; i < flown_.poses.size(); ++i) {
    length += (flown_.poses[i].position - from).norm();
    from = flown_.poses[i].position;
  }
  return length;
}

void FlightAction::finish(PilotStatus status, const std::string& message) {
  const NavigatePathResult result = endedWith(toString(status), message);
  if (status == PilotStatus::ARRIVED)
    server_.setSucceeded(result, message);
  else if (status == PilotStatus::CANCELLED && server_.isPreemptRequested())
    server_.setPreempted(result, message);
  else
    server_.setAborted(result, message);
}

void FlightAction::refuse(const std::string& message) {
  server_.setAborted(endedWith("INVALID_REQUEST", message), message);
}

NavigatePathResult FlightAction::endedWith(const std::string& status, const std::string& message) {
  active_ = false;
  NavigatePathResult result;
  result.status = status;
  result.message = message;
  if (!flown_.poses.empty()) {
    result.position_error_m = (flown_.poses.back().position - at_.position).norm();
    result.yaw_error_rad = std::abs(std::remainder(flown_.poses.back().yaw - at_.yaw, 2.0 * M_PI));
  }
  return result;
}

}  // namespace grid_path_planner::nodes
