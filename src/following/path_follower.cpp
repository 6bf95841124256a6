#include "grid_path_planner/following/path_follower.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <utility>

#include "following/check_waypoints.h"
#include "following/follow_events.h"
#include "following/route_progress.h"
#include "following/speed_limit.h"
#include "following/velocity_controller.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/path/waypoint_file.h"

namespace grid_path_planner::following {

using base::BodyVelocity;
using path::kLargestCoordinate;
using path::lengthOf;
using path::Path;
using path::Pose;

namespace {

using Kind = FollowEvent::Kind;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Empty for a time and a pose that velocities can be computed from.
std::string whyUnusable(const FollowInput& input) {
  if (!std::isfinite(input.time)) return "the time is not finite";
  if (!input.pose) return "";
  const Pose& pose = *input.pose;
  const bool usable = pose.position.allFinite() && std::isfinite(pose.yaw) &&
                      pose.position.cwiseAbs().maxCoeff() <= kLargestCoordinate;
  if (usable) return "";
  std::ostringstream text;
  text << "the vehicle's pose must be finite and within 1e6 m of 0, got x " << pose.position.x()
       << ", y " << pose.position.y() << ", z " << pose.position.z() << ", yaw " << pose.yaw;
  return text.str();
}

bool isFinite(const BodyVelocity& v) {
  return std::isfinite(v.surge) && std::isfinite(v.sway) && std::isfinite(v.heave) &&
         std::isfinite(v.yaw_rate);
}

std::string metres(double length) {
  std::ostringstream text;
  text << std::setprecision(4) << length << " m";
  return text.str();
}

const Pose& currentPose(const PathFollower& follower) {
  return follower.path().poses[static_cast<std::size_t>(follower.currentWaypoint())];
}

}  // namespace

PathFollower::PathFollower(const FollowerOptions& options)
    : events_(std::make_unique<FollowEvents>()),
      progress_(std::make_unique<RouteProgress>(Path(), Join::FIRST, options_, *events_)),
      controller_(std::make_unique<VelocityController>(options_)) {
  setOptions(options);
}

PathFollower::~PathFollower() = default;

void PathFollower::setOptions(const FollowerOptions& options) {
  checkFollowerOptions(options);
  options_ = options;
  progress_->updateRoute();
}

void PathFollower::start(const Path& path, Join join) {
  checkWaypoints(path, options_.loop);
  if (path.frame_id != progress_->path().frame_id) controller_->changeFrame();
  progress_ = std::make_unique<RouteProgress>(path, join, options_, *events_);
  if (!std::exchange(starts_paused_, false) && state_ != FollowState::PAUSED)
    state_ = FollowState::DRIVING;
  else
    state_ = FollowState::PAUSED;
  status_ = DriveStatus::NONE;
  message_ = "drives a path of " + std::to_string(path.poses.size()) + " waypoints, " +
             metres(lengthOf(path));
  if (state_ == FollowState::PAUSED) message_ += ", once it is resumed";
  length_ = {};
  blocked_since_.reset();
  controller_->release();
  events_->report(Kind::STARTED, -1, message_);
}

bool PathFollower::active() const {
  return state_ == FollowState::DRIVING || state_ == FollowState::PAUSED ||
         state_ == FollowState::BLOCKED;
}

PathFollower::Answer PathFollower::pause() {
  if (starts_paused_ || state_ == FollowState::PAUSED) return {true, "paused already"};
  if (!active()) return pauseTheNext();
  state_ = FollowState::PAUSED;
  blocked_since_.reset();
  standStill();
  return {true, "paused while driving to " + progress_->currentName()};
}

PathFollower::Answer PathFollower::pauseTheNext() {
  const bool held = state_ == FollowState::ARRIVED && options_.hold_pose;
  cancel("paused");
  starts_paused_ = true;
  return {true, std::string(held ? "the pose at the end of the path is not held any more"
                                 : "nothing is driven") +
                    ": the next path waits until it is resumed"};
}

PathFollower::Answer PathFollower::resume() {
  if (std::exchange(starts_paused_, false)) return {true, "resumed: the next path is driven"};
  if (!active()) return {false, std::string("nothing to resume: ") + toString(state_)};
  if (state_ != FollowState::PAUSED) return {true, "not paused"};
  state_ = FollowState::DRIVING;
  return {true, "resumed while driving to " + progress_->currentName()};
}

void PathFollower::abandon(const std::string& reason) {
  const bool paused = starts_paused_ || state_ == FollowState::PAUSED;
  cancel(reason);
  starts_paused_ = paused;
}

PathFollower::Answer PathFollower::cancel(const std::string& reason) {
  standStill();
  starts_paused_ = false;
  if (active()) {
    end({FollowState::CANCELLED, DriveStatus::CANCELLED, reason});
    return {true, "cancelled while driving to " + progress_->currentName()};
  }
  if (state_ == FollowState::ARRIVED) state_ = FollowState::IDLE;
  return {true, "nothing was being driven"};
}

BodyVelocity PathFollower::update(const FollowInput& input) {
  const bool moves = state_ == FollowState::DRIVING || state_ == FollowState::BLOCKED ||
                     state_ == FollowState::ARRIVED;
  const std::string why = whyUnusable(input);
  if (!why.empty()) {
    if (moves) end({FollowState::FAILED, DriveStatus::INVALID_POSE, why});
    return {};
  }
  const BodyVelocity velocity = velocityFor(input);
  if (isFinite(velocity)) return velocity;
  end({FollowState::FAILED, DriveStatus::INVALID_POSE, "the velocity would not be finite"});
  return {};
}

BodyVelocity PathFollower::velocityFor(const FollowInput& input) {
  const double seconds = time_ ? input.time - *time_ : 0.0;
  time_ = input.time;
  if (seconds < 0.0) {
    abandon("time went back by " + std::to_string(-seconds) + " s");
    return {};
  }
  if (input.pose) pose_ = input.pose;
  if (state_ == FollowState::ARRIVED && input.pose && input.hold.empty())
    return holdEnd(input, seconds);
  if (state_ != FollowState::DRIVING && state_ != FollowState::BLOCKED) {
    standStill();
    return {};
  }
  if (input.pose && !progress_->joined()) progress_->join(*input.pose);
  if (isBlocked(input)) {
    standStill();
    return {};
  }
  limitSpeed(input, progress_->ahead(input.pose->position, speedLimitLookahead(options_)));
  return drive(*input.pose, input.time, seconds);
}

// Back to the end of the path, where nothing stands between.
BodyVelocity PathFollower::holdEnd(const FollowInput& input, double seconds) {
  const std::vector<Eigen::Vector3d> back = {input.pose->position, path().poses.back().position};
  if (input.check && !input.check(back).empty()) {
    standStill();
    return {};
  }
  limitSpeed(input, back);
  return controller_->holdPose(path().poses.back(), *input.pose, seconds);
}

void PathFollower::limitSpeed(const FollowInput& input, const std::vector<Eigen::Vector3d>& ahead) {
  controller_->limitSpeed(input.speed ? input.speed(ahead)
                                      : std::numeric_limits<double>::infinity());
}

bool PathFollower::isBlocked(const FollowInput& input) {
  const std::string why = whyNot(input);
  if (!why.empty()) {
    obstructed_ = input.hold.empty() && input.pose;
    const bool lost = input.hold.empty() && !input.pose;
    block(input.time, lost ? DriveStatus::TF_STALE : DriveStatus::BLOCKED, why);
    return true;
  }
  if (state_ == FollowState::BLOCKED) {
    state_ = FollowState::DRIVING;
    message_ = "goes on";
    events_->report(Kind::UNBLOCKED, currentWaypoint(), message_);
  }
  blocked_since_.reset();
  return false;
}

std::string PathFollower::whyNot(const FollowInput& input) const {
  if (!input.hold.empty()) return input.hold;
  if (!input.pose)
    return input.pose_problem.empty() ? "the vehicle's pose is not known" : input.pose_problem;
  if (!input.check) return "";
  return input.check(progress_->ahead(input.pose->position, options_.lookahead));
}

void PathFollower::block(double time, DriveStatus cause, const std::string& why) {
  progress_->restartSettling();
  progress_->restartProgress();
  if (state_ != FollowState::BLOCKED) events_->report(Kind::BLOCKED, currentWaypoint(), why);
  state_ = FollowState::BLOCKED;
  message_ = why;
  if (!blocked_since_) blocked_since_ = time;
  if (options_.blocked_timeout > 0.0 && time - *blocked_since_ >= options_.blocked_timeout)
    end({FollowState::FAILED, cause, why});
}

BodyVelocity PathFollower::drive(const Pose& vehicle, double time, double seconds) {
  if (const auto ending = progress_->advance(vehicle, time)) {
    end(*ending);
    return {};
  }
  reportHalfway();
  return controller_->follow(progress_->position(vehicle.position), vehicle, seconds);
}

void PathFollower::reportHalfway() {
  const double left = distanceRemaining();
  if (!length_) length_ = left;
  if (options_.loop || *length_ <= 0.0 || left > 0.5 * *length_) return;
  length_ = 0.0;
  events_->report(Kind::HALFWAY, currentWaypoint(),
                  "half of the path is driven, " + metres(left) + " are left; " +
                      progress_->currentName() + " is next");
}

void PathFollower::end(const DriveEnd& ending) {
  state_ = ending.state;
  status_ = ending.status;
  message_ = ending.message;
  blocked_since_.reset();
  standStill();
  events_->report(Kind::ENDED, currentWaypoint(), std::string(toString(status_)) + ": " + message_);
}

void PathFollower::standStill() {
  controller_->stop();
  progress_->restartProgress();
}

const Path& PathFollower::path() const {
  return progress_->path();
}

int PathFollower::currentWaypoint() const {
  return progress_->currentWaypoint();
}

double PathFollower::distanceRemaining() const {
  if (!progress_->joined() || !pose_) return std::numeric_limits<double>::infinity();
  return progress_->distanceRemaining(pose_->position);
}

double PathFollower::timeRemaining() const {
  if (!progress_->joined() || !pose_) return std::numeric_limits<double>::infinity();
  return progress_->timeRemaining(pose_->position);
}

const std::vector<int>& PathFollower::missedWaypoints() const {
  return progress_->missed();
}

double PathFollower::positionError() const {
  if (!pose_ || path().empty()) return kNaN;
  return (currentPose(*this).position - pose_->position).norm();
}

double PathFollower::yawError() const {
  if (!pose_ || path().empty()) return kNaN;
  return std::abs(angleBetween(pose_->yaw, currentPose(*this).yaw));
}

std::vector<FollowEvent> PathFollower::takeEvents() {
  return events_->take();
}

}  // namespace grid_path_planner::following
