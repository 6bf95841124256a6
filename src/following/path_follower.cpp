#include "grid_path_planner/following/path_follower.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <utility>

#include "following/check_waypoints.h"
#include "following/follow_events.h"
#include "following/free_steering.h"
#include "following/pose_jumps.h"
#include "following/route_progress.h"
#include "following/speed_limit.h"
#include "following/sway_check.h"
#include "following/velocity_controller.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "vehicle/description.h"

namespace grid_path_planner::following {

using base::BodyVelocity;
using path::kLargestCoordinate;
using path::lengthOf;
using path::Path;
using path::Pose;
using vehicle::Description;
using vehicle::Drive;

struct PathFollower::Watch {
  PoseJumps jumps;
  SwayCheck sway;
  double arrived_at = 0.0;              // s
  bool holding_ended = false;           // after the last arrival
  std::optional<double> touches_since;  // since when nothing but a zero is free
  BodyVelocity commanded;               // last
};

namespace {

using Kind = FollowEvent::Kind;

constexpr double kTouching = 0.5;  // s without a free motion, after which a drive is blocked
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

PathFollower::PathFollower(const FollowerOptions& options, const Description* vehicle)
    : vehicle_(vehicle ? std::make_unique<Description>(*vehicle) : nullptr),
      events_(std::make_unique<FollowEvents>()),
      progress_(std::make_unique<RouteProgress>(Path(), Join::FIRST, options_, *events_)),
      controller_(makeController(options_, vehicle_.get())),
      watch_(std::make_unique<Watch>()) {
  setOptions(options);
}

PathFollower::~PathFollower() = default;

void PathFollower::setOptions(const FollowerOptions& options) {
  checkFollowerOptions(options);
  options_ = options;
  if (vehicle_ && vehicle_->drive != Drive::OMNIDIRECTIONAL) options_.facing = FacingMode::ALONG;
  if (vehicle_ && vehicle_->drive == Drive::CAR) options_.yaw_tolerance = M_PI;
  progress_->updateRoute();
}

void PathFollower::start(const Path& path, Join join) {
  checkWaypoints(path, options_.loop);
  if (path.frame_id != progress_->path().frame_id) {
    controller_->changeFrame();
    watch_->jumps.forget();
  }
  Path driven = path;
  if (vehicle_ && !vehicle_->changesHeight())
    for (Pose& pose : driven.poses) pose.position.z() = path.poses.front().position.z();
  progress_ = std::make_unique<RouteProgress>(std::move(driven), join, options_, *events_);
  watch_->sway.restart();
  watch_->touches_since.reset();
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
  const bool held = state_ == FollowState::ARRIVED && options_.hold_pose && !watch_->holding_ended;
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

// A vehicle that cannot change its height is on the path's plane, wherever base_link is above it.
FollowInput PathFollower::levelled(FollowInput input) const {
  if (input.pose && vehicle_ && !vehicle_->changesHeight() && !path().empty())
    input.pose->position.z() = path().poses.front().position.z();
  return input;
}

BodyVelocity PathFollower::velocityFor(const FollowInput& given) {
  const FollowInput input = levelled(given);
  const double seconds = time_ ? input.time - *time_ : 0.0;
  time_ = input.time;
  if (seconds < 0.0) {
    watch_->jumps.forget();
    abandon("time went back by " + std::to_string(-seconds) + " s");
    return {};
  }
  if (input.pose) {
    if (jumped(input)) return {};
    pose_ = input.pose;
  }
  if (state_ == FollowState::ARRIVED && input.pose && input.hold.empty())
    return holdEnd(input, seconds);
  if (state_ != FollowState::DRIVING && state_ != FollowState::BLOCKED) {
    standStill();
    return {};
  }
  if (input.pose && !progress_->joined()) progress_->join(*input.pose);
  const std::string why = whyNot(input);
  if (!why.empty()) {
    watch_->touches_since.reset();
    obstructed_ = input.hold.empty() && input.pose;
    const bool lost = input.hold.empty() && !input.pose;
    block(input.time, lost ? DriveStatus::TF_STALE : DriveStatus::BLOCKED, why);
    return {};
  }
  if (!watch_->touches_since) unblock();
  limitSpeed(input, progress_->ahead(input.pose->position, speedLimitLookahead(options_)));
  return drive(input, seconds);
}

// Whoever plans has to say how to go on from there.
bool PathFollower::jumped(const FollowInput& input) {
  const auto distance = watch_->jumps.note(*input.pose, input.time - input.pose_age, options_);
  if (!distance) return false;
  const std::string what =
      "the vehicle's pose jumped by " + metres(*distance) + ", more than it can have driven";
  if (state_ == FollowState::ARRIVED) {
    giveUpHolding(what);
    return false;
  }
  if (!active()) return false;
  pose_ = input.pose;
  end({FollowState::FAILED, DriveStatus::POSE_JUMP, what + ": a new path from there is needed"});
  return true;
}

// Whether the pose at the end of the path is one to be returned to still.
bool PathFollower::holds(const FollowInput& input) {
  if (watch_->holding_ended || !options_.hold_pose) return false;
  const double off = positionError();
  if (off > options_.hold_distance)
    giveUpHolding("it is " + metres(off) + " off, more than hold_distance");
  else if (input.time - watch_->arrived_at > options_.hold_time)
    giveUpHolding("hold_time is over");
  return !watch_->holding_ended;
}

void PathFollower::giveUpHolding(const std::string& why) {
  if (!options_.hold_pose || std::exchange(watch_->holding_ended, true)) return;
  message_ += "; it is not brought back there any more: " + why;
}

bool PathFollower::holdingEnded() const {
  return state_ == FollowState::ARRIVED && watch_->holding_ended &&
         (positionError() > options_.position_tolerance || yawError() > options_.yaw_tolerance);
}

// Back to the end of the path, where nothing stands between.
BodyVelocity PathFollower::holdEnd(const FollowInput& input, double seconds) {
  const std::vector<Eigen::Vector3d> back = {input.pose->position, path().poses.back().position};
  if (!holds(input) || (input.check && !input.check(back).empty())) {
    standStill();
    return {};
  }
  limitSpeed(input, back);
  const FreeSteering free =
      freeSteering(controller_->holdPose(path().poses.back(), *input.pose, seconds), input.motion);
  controller_->take(free.steering.value_or(Steering()));
  return free.steering ? free.steering->command : BodyVelocity();
}

void PathFollower::limitSpeed(const FollowInput& input, const std::vector<Eigen::Vector3d>& ahead) {
  controller_->limitSpeed(input.speed ? input.speed(ahead)
                                      : std::numeric_limits<double>::infinity());
}

void PathFollower::unblock() {
  if (state_ == FollowState::BLOCKED) {
    state_ = FollowState::DRIVING;
    message_ = "goes on";
    events_->report(Kind::UNBLOCKED, currentWaypoint(), message_);
  }
  blocked_since_.reset();
}

std::string PathFollower::whyNot(const FollowInput& input) const {
  if (!input.hold.empty()) return input.hold;
  if (!input.pose)
    return input.pose_problem.empty() ? "the vehicle's pose is not known" : input.pose_problem;
  if (!input.check) return "";
  return input.check(progress_->ahead(input.pose->position, options_.lookahead));
}

void PathFollower::block(double time, DriveStatus cause, const std::string& why) {
  standStill();
  progress_->restartSettling();
  progress_->restartProgress();
  if (state_ != FollowState::BLOCKED) events_->report(Kind::BLOCKED, currentWaypoint(), why);
  state_ = FollowState::BLOCKED;
  message_ = why;
  if (!blocked_since_) blocked_since_ = time;
  if (options_.blocked_timeout > 0.0 && time - *blocked_since_ >= options_.blocked_timeout)
    end({FollowState::FAILED, cause, why});
}

BodyVelocity PathFollower::drive(const FollowInput& input, double seconds) {
  if (!vehicle_ && !watch_->sway.follows(*input.pose, watch_->commanded.sway, seconds)) {
    end({FollowState::FAILED, DriveStatus::WRONG_DRIVE,
         "the vehicle does not go sideways as linear.y commands it: describe it, with drive: "
         "differential or car (the argument vehicle of the launch files)"});
    return {};
  }
  if (const auto ending = progress_->advance(*input.pose, input.time)) {
    end(*ending);
    return {};
  }
  reportHalfway();
  return watch_->commanded = steer(input, seconds);
}

BodyVelocity PathFollower::steer(const FollowInput& input, double seconds) {
  const FreeSteering free = freeSteering(*controller_, progress_->position(input.pose->position),
                                         *input.pose, seconds, input.motion);
  if (free.steering) {
    if (std::exchange(watch_->touches_since, std::nullopt)) unblock();
    controller_->take(*free.steering);
    return free.steering->command;
  }
  standStill();
  if (!watch_->touches_since) watch_->touches_since = input.time;
  if (input.time - *watch_->touches_since < kTouching) return {};
  obstructed_ = true;
  block(input.time, DriveStatus::BLOCKED, free.problem);
  return {};
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
  watch_->arrived_at = time_.value_or(0.0);
  watch_->holding_ended = false;
  standStill();
  events_->report(Kind::ENDED, currentWaypoint(), std::string(toString(status_)) + ": " + message_);
}

void PathFollower::standStill() {
  controller_->stop();
  watch_->commanded = {};
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
