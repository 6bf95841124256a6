#include "grid_path_planner/following/path_follower.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "following/check_waypoints.h"
#include "following/driven_route.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::following {

using base::BodyVelocity;
using base::decimalText;
using path::Path;
using path::Pose;

namespace {

using Eigen::Vector3d;
using Kind = FollowEvent::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kProgress = 0.05;  // m and rad: less is no progress

std::vector<Knot> knotsOf(const Path& path, std::size_t first, bool loop) {
  std::vector<Knot> knots;
  for (std::size_t i = first; i < path.poses.size(); ++i)
    knots.push_back({path.poses[i], static_cast<int>(i), !loop && i + 1 == path.poses.size()});
  return knots;
}

struct JoinPoint {
  Pose pose;
  std::size_t next = 0;  // the waypoint after it
};

// The point of the path nearest to `position`; of several that are nearest to within `slack`
// metres, the first, so that a closed path is not joined at its end.
JoinPoint nearestPoint(const Path& path, const Vector3d& position, double slack) {
  const std::vector<Pose>& poses = path.poses;
  JoinPoint best{poses[0], 0};
  double least = (poses[0].position - position).norm();
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const Vector3d way = poses[i + 1].position - poses[i].position;
    const double square = way.squaredNorm();
    if (square == 0.0) continue;
    const double share = std::clamp((position - poses[i].position).dot(way) / square, 0.0, 1.0);
    const Vector3d point = poses[i].position + share * way;
    const double distance = (point - position).norm();
    const bool goes_on = best.next == i && share > 0.0;  // the same stretch: no slack needed
    if (distance >= (goes_on ? least : least - slack)) continue;
    least = distance;
    const double turn = angleBetween(poses[i].yaw, poses[i + 1].yaw);
    best = {{point, poses[i].yaw + share * turn}, share > 0.0 ? i + 1 : i};
  }
  return best;
}

double towards(double from, double to, double largest) {
  return from + std::clamp(to - from, -largest, largest);
}

Vector3d towards(const Vector3d& from, const Vector3d& to, double largest) {
  const Vector3d change = to - from;
  const double size = change.norm();
  return size > largest ? Vector3d(from + change * (largest / size)) : to;
}

}  // namespace

const char* toString(FollowState state) {
  switch (state) {
    case FollowState::IDLE:
      return "idle";
    case FollowState::DRIVING:
      return "driving";
    case FollowState::PAUSED:
      return "paused";
    case FollowState::BLOCKED:
      return "blocked";
    case FollowState::ARRIVED:
      return "arrived";
    case FollowState::CANCELLED:
      return "cancelled";
    case FollowState::FAILED:
      return "failed";
  }
  return "?";
}

const char* toString(DriveStatus status) {
  switch (status) {
    case DriveStatus::NONE:
      return "NONE";
    case DriveStatus::ARRIVED:
      return "ARRIVED";
    case DriveStatus::CANCELLED:
      return "CANCELLED";
    case DriveStatus::BLOCKED:
      return "BLOCKED";
    case DriveStatus::TF_STALE:
      return "TF_STALE";
    case DriveStatus::NO_PROGRESS:
      return "NO_PROGRESS";
    case DriveStatus::MISSED_WAYPOINT:
      return "MISSED_WAYPOINT";
  }
  return "?";
}

PathFollower::PathFollower(const FollowerOptions& options) {
  setOptions(options);
}

PathFollower::~PathFollower() = default;

void PathFollower::setOptions(const FollowerOptions& options) {
  checkFollowerOptions(options);
  options_ = options;
  if (route_) route_->update(options_);
}

void PathFollower::start(const Path& path, Join join) {
  checkWaypoints(path, options_.loop);
  path_ = path;
  join_ = join;
  loop_ = options_.loop;
  route_.reset();
  segment_ = 0;
  current_waypoint_ = 0;
  missed_.clear();
  retries_ = 0;
  if (state_ != FollowState::PAUSED) state_ = FollowState::DRIVING;
  status_ = DriveStatus::NONE;
  message_ = "drives a path of " + std::to_string(path.poses.size()) + " waypoints";
  blocked_since_.reset();
  returns_ = false;
  report(Kind::STARTED, -1, message_);
}

bool PathFollower::active() const {
  return state_ == FollowState::DRIVING || state_ == FollowState::PAUSED ||
         state_ == FollowState::BLOCKED;
}

PathFollower::Answer PathFollower::pause() {
  if (!active()) return {false, std::string("nothing to pause: ") + toString(state_)};
  if (state_ == FollowState::PAUSED) return {true, "paused already"};
  state_ = FollowState::PAUSED;
  blocked_since_.reset();
  standStill();
  return {true, "paused on the way to " + nameOf(current_waypoint_)};
}

PathFollower::Answer PathFollower::resume() {
  if (!active()) return {false, std::string("nothing to resume: ") + toString(state_)};
  if (state_ != FollowState::PAUSED) return {true, "not paused"};
  state_ = FollowState::DRIVING;
  return {true, "resumed on the way to " + nameOf(current_waypoint_)};
}

PathFollower::Answer PathFollower::cancel(const std::string& reason) {
  standStill();
  if (active()) {
    end(FollowState::CANCELLED, DriveStatus::CANCELLED, reason);
    return {true, "cancelled on the way to " + nameOf(current_waypoint_)};
  }
  if (state_ == FollowState::ARRIVED) state_ = FollowState::IDLE;
  return {true, "nothing was being driven"};
}

BodyVelocity PathFollower::update(const FollowInput& input) {
  const double seconds = time_ ? input.time - *time_ : 0.0;
  time_ = input.time;
  if (seconds < 0.0) {
    cancel("time went back by " + std::to_string(-seconds) + " s");
    return {};
  }
  if (input.pose) pose_ = input.pose;
  if (state_ == FollowState::ARRIVED && input.pose) return holdPose(*input.pose, seconds);
  if (state_ != FollowState::DRIVING && state_ != FollowState::BLOCKED) {
    standStill();
    return {};
  }
  if (input.pose && !route_) join(*input.pose);
  if (isHindered(input)) {
    standStill();
    return {};
  }
  return drive(*input.pose, input.time, seconds);
}

void PathFollower::join(const Pose& vehicle) {
  std::vector<Knot> knots{{vehicle}};
  std::size_t first = 0;
  if (join_ == Join::NEAREST) {
    const JoinPoint joined = nearestPoint(path_, vehicle.position, options_.position_tolerance);
    first = joined.next;
    knots.push_back({joined.pose});
  }
  const std::vector<Knot> waypoints = knotsOf(path_, first, loop_);
  knots.insert(knots.end(), waypoints.begin(), waypoints.end());
  if (first > 0)
    report(Kind::JOINED, static_cast<int>(first),
           "joins the path before " + nameOf(static_cast<int>(first)) + ": " +
               std::to_string(first) + " before it are not driven");
  route_ = std::make_unique<DrivenRoute>(std::move(knots), options_);
  beginSegment(0);
}

bool PathFollower::isHindered(const FollowInput& input) {
  if (!input.pose) {
    const bool explained = !input.pose_problem.empty();
    block(input.time, DriveStatus::TF_STALE,
          explained ? input.pose_problem : "the vehicle's pose is not known");
    return true;
  }
  if (input.check) {
    const double share = shareOf(input.pose->position);
    const std::string why = input.check(route_->piece(segment_, share, options_.lookahead));
    if (!why.empty()) {
      block(input.time, DriveStatus::BLOCKED, why);
      return true;
    }
  }
  if (state_ == FollowState::BLOCKED) {
    state_ = FollowState::DRIVING;
    message_ = "goes on";
    report(Kind::UNBLOCKED, current_waypoint_, message_);
  }
  blocked_since_.reset();
  return false;
}

void PathFollower::block(double time, DriveStatus cause, const std::string& why) {
  settled_since_.reset();
  progress_since_.reset();
  if (state_ != FollowState::BLOCKED) report(Kind::BLOCKED, current_waypoint_, why);
  state_ = FollowState::BLOCKED;
  message_ = why;
  if (!blocked_since_) blocked_since_ = time;
  if (options_.blocked_timeout > 0.0 && time - *blocked_since_ >= options_.blocked_timeout)
    end(FollowState::FAILED, cause, why);
}

BodyVelocity PathFollower::drive(const Pose& vehicle, double time, double seconds) {
  advance(vehicle, time);
  if (state_ == FollowState::DRIVING) watchProgress(vehicle, time);
  if (state_ != FollowState::DRIVING) {
    standStill();
    return {};
  }
  return limited(vehicle, wantedVelocity(vehicle.position),
                 angleBetween(vehicle.yaw, wantedYaw(vehicle)), seconds);
}

// Goes to the next segment for as often as the end of the present one has been reached or passed.
void PathFollower::advance(const Pose& vehicle, double time) {
  const std::size_t most = route_->segments();  // per update: no endless laps round a tiny loop
  for (std::size_t i = 0; i <= most; ++i) {
    const Knot& target = route_->knots()[segment_ + 1];
    closest_ = std::min(closest_, (target.pose.position - vehicle.position).norm());
    if (target.stop) {
      if (!isSettled(vehicle, time)) return;
      const bool last = target.last;
      reach(target.waypoint);
      if (last) {
        end(FollowState::ARRIVED, DriveStatus::ARRIVED, "arrived at " + nameOf(current_waypoint_));
        return;
      }
    } else {
      if (!isPassed(vehicle.position)) return;
      if (closest_ <= options_.acceptance_radius)
        reach(target.waypoint);
      else if (!isMissedButGoesOn(vehicle))
        return;
    }
    beginSegment(segment_ + 1);
  }
}

bool PathFollower::isSettled(const Pose& vehicle, double time) {
  const Pose& target = route_->knots()[segment_ + 1].pose;
  const double distance = (target.position - vehicle.position).norm();
  if (distance <= options_.position_tolerance) at_stop_ = true;
  const bool inside = distance <= options_.position_tolerance &&
                      std::abs(angleBetween(vehicle.yaw, target.yaw)) <= options_.yaw_tolerance;
  if (!inside) {
    settled_since_.reset();
    return false;
  }
  if (!settled_since_) settled_since_ = time;
  return time - *settled_since_ >= options_.settle_time;
}

bool PathFollower::isPassed(const Vector3d& position) const {
  if (route_->share(segment_, position) >= 1.0) return true;
  if (closest_ > options_.acceptance_radius) return false;
  const double away = (route_->knots()[segment_ + 1].pose.position - position).norm();
  if (away <= options_.position_tolerance) return true;
  if (route_->turnsBack(segment_))
    return away <= std::min(options_.acceptance_radius, 0.5 * options_.pursuit_distance);
  return route_->distance(segment_ + 1, position) <= route_->distance(segment_, position);
}

// By the policy for missed waypoints; whether the next segment is to be driven.
bool PathFollower::isMissedButGoesOn(const Pose& vehicle) {
  const int waypoint = route_->knots()[segment_ + 1].waypoint;
  if (waypoint < 0) return true;
  const std::string what = "passed " + nameOf(waypoint) + " at " + std::to_string(closest_) + " m";
  if (options_.missed_waypoint == MissedPolicy::RETRY && retries_ < options_.max_retries) {
    ++retries_;
    report(Kind::RETRY, waypoint, what + ": tries again");
    std::vector<Knot> knots{{vehicle}};
    knots.insert(knots.end(), route_->knots().begin() + static_cast<long>(segment_) + 1,
                 route_->knots().end());
    route_ = std::make_unique<DrivenRoute>(std::move(knots), options_);
    beginSegment(0);
    return false;
  }
  missed_.push_back(waypoint);
  report(Kind::MISSED, waypoint, what);
  if (options_.missed_waypoint == MissedPolicy::SKIP) return true;
  end(FollowState::FAILED, DriveStatus::MISSED_WAYPOINT, what);
  return false;
}

void PathFollower::reach(int waypoint) {
  if (waypoint < 0) return;
  report(Kind::REACHED, waypoint, "reached " + nameOf(waypoint));
  if (loop_ && waypoint + 1 == static_cast<int>(path_.poses.size()))
    report(Kind::LAP, waypoint, "a lap is done");
}

void PathFollower::beginSegment(std::size_t segment) {
  segment_ = segment;
  closest_ = kInfinity;
  at_stop_ = false;
  settled_since_.reset();
  progress_since_.reset();
  appendLap();
  const auto& knots = route_->knots();
  const auto next = std::find_if(knots.begin() + static_cast<long>(segment_) + 1, knots.end(),
                                 [](const Knot& knot) { return knot.waypoint >= 0; });
  current_waypoint_ = next->waypoint;
}

// In a loop there is always a whole lap ahead; what lies behind is dropped.
void PathFollower::appendLap() {
  if (!loop_ || route_->segments() - segment_ > path_.poses.size()) return;
  std::vector<Knot> knots(route_->knots().begin() + static_cast<long>(segment_),
                          route_->knots().end());
  const std::vector<Knot> lap = knotsOf(path_, 0, loop_);
  knots.insert(knots.end(), lap.begin(), lap.end());
  route_ = std::make_unique<DrivenRoute>(std::move(knots), options_);
  segment_ = 0;
}

void PathFollower::watchProgress(const Pose& vehicle, double time) {
  const double share = shareOf(vehicle.position);
  const double left = (1.0 - share) * route_->length(segment_) +
                      (route_->point(segment_, share) - vehicle.position).norm() +
                      std::abs(angleBetween(vehicle.yaw, wantedYaw(vehicle)));
  if (!progress_since_ || settled_since_ || left < least_left_ - kProgress) {
    progress_since_ = time;
    least_left_ = left;
  }
  if (options_.no_progress_timeout > 0.0 && time - *progress_since_ >= options_.no_progress_timeout)
    end(FollowState::FAILED, DriveStatus::NO_PROGRESS,
        "no progress for " + decimalText(options_.no_progress_timeout) + " s on the way to " +
            nameOf(current_waypoint_));
}

double PathFollower::shareOf(const Vector3d& position) const {
  return std::clamp(route_->share(segment_, position), 0.0, 1.0);
}

// Along the path as fast as corners and stops allow, and towards it. The farther off the slower
// along; from the acceptance radius on only towards it.
Vector3d PathFollower::wantedVelocity(const Vector3d& position) const {
  const double share = shareOf(position);
  const Vector3d on_path = route_->point(segment_, share);
  const Vector3d off = on_path - position;
  const double distance = off.norm();

  const Vector3d chord = route_->ahead(segment_, share, options_.pursuit_distance) - on_path;
  const double part = std::min(1.0, distance / options_.acceptance_radius);
  const double along = route_->speed(segment_, share, options_) * (1.0 - part * part);
  Vector3d velocity = Vector3d::Zero();
  if (chord.norm() > 1e-9) velocity = chord.normalized() * along;
  if (distance > 1e-9)
    velocity += off / distance *
                std::min(options_.position_gain * distance,
                         std::sqrt(2.0 * 0.8 * options_.max_acceleration * distance));
  return velocity;
}

double PathFollower::wantedYaw(const Pose& vehicle) const {
  const Pose& from = route_->knots()[segment_].pose;
  const Knot& target = route_->knots()[segment_ + 1];
  if (target.stop && at_stop_) return target.pose.yaw;
  const double share = shareOf(vehicle.position);
  if (options_.facing == FacingMode::ALONG) {
    const Vector3d chord =
        route_->ahead(segment_, share, options_.pursuit_distance) - route_->point(segment_, share);
    if (chord.head<2>().norm() > options_.position_tolerance)
      return std::atan2(chord.y(), chord.x());
    return target.stop ? target.pose.yaw : vehicle.yaw;
  }
  return from.yaw + share * angleBetween(from.yaw, target.pose.yaw);
}

BodyVelocity PathFollower::holdPose(const Pose& vehicle, double seconds) {
  const Pose& target = path_.poses.back();
  const Vector3d off = target.position - vehicle.position;
  const double turn = angleBetween(vehicle.yaw, target.yaw);
  const double error =
      std::max(off.norm() / options_.position_tolerance, std::abs(turn) / options_.yaw_tolerance);
  returns_ = options_.hold_pose && error > (returns_ ? 0.5 : 1.0);
  if (!returns_) {
    standStill();
    return {};
  }
  return limited(vehicle, options_.position_gain * off, turn, seconds);
}

// In the body frame, inside the limits of speed and of its change since the last update.
BodyVelocity PathFollower::limited(const Pose& vehicle, Vector3d velocity, double yaw_error,
                                   double seconds) {
  const double plane = velocity.head<2>().norm();
  const double vertical = std::abs(velocity.z());
  double scale = 1.0;
  if (plane > options_.max_speed) scale = options_.max_speed / plane;
  if (vertical * scale > options_.max_vertical_speed)
    scale = options_.max_vertical_speed / vertical;
  velocity_ = towards(velocity_, velocity * scale, options_.max_acceleration * seconds);

  const double braking = std::sqrt(2.0 * 0.8 * options_.max_yaw_acceleration * std::abs(yaw_error));
  const double fastest = std::min(options_.max_yaw_rate, braking);
  const double rate = std::clamp(options_.yaw_gain * yaw_error, -fastest, fastest);
  yaw_rate_ = towards(yaw_rate_, rate, options_.max_yaw_acceleration * seconds);

  const double c = std::cos(vehicle.yaw), s = std::sin(vehicle.yaw);
  return {c * velocity_.x() + s * velocity_.y(), -s * velocity_.x() + c * velocity_.y(),
          velocity_.z(), yaw_rate_};
}

void PathFollower::end(FollowState state, DriveStatus status, const std::string& message) {
  state_ = state;
  status_ = status;
  message_ = message;
  blocked_since_.reset();
  standStill();
  report(Kind::ENDED, current_waypoint_, std::string(toString(status)) + ": " + message);
}

void PathFollower::report(Kind kind, int waypoint, const std::string& message) {
  events_.push_back({kind, waypoint, message});
}

void PathFollower::standStill() {
  velocity_.setZero();
  yaw_rate_ = 0.0;
  progress_since_.reset();
}

std::string PathFollower::nameOf(int waypoint) const {
  return "waypoint " + std::to_string(waypoint + 1) + " of " + std::to_string(path_.poses.size());
}

double PathFollower::distanceRemaining() const {
  if (!route_ || !pose_) return kInfinity;
  if (segment_ >= route_->segments()) return 0.0;
  const auto& knots = route_->knots();
  std::size_t end = segment_ + 1;
  while (end + 1 < knots.size() && knots[end].waypoint + 1 != static_cast<int>(path_.poses.size()))
    ++end;
  const double share = shareOf(pose_->position);
  return knots[end].s - knots[segment_].s - share * route_->length(segment_);
}

double PathFollower::positionError() const {
  if (!pose_ || path_.empty()) return std::numeric_limits<double>::quiet_NaN();
  return (path_.poses[current_waypoint_].position - pose_->position).norm();
}

double PathFollower::yawError() const {
  if (!pose_ || path_.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(angleBetween(pose_->yaw, path_.poses[current_waypoint_].yaw));
}

std::vector<FollowEvent> PathFollower::takeEvents() {
  return std::exchange(events_, {});
}

}  // namespace grid_path_planner::following
