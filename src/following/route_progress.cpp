#include "following/route_progress.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "following/driving_time.h"
#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::following {

using base::decimalText;
using path::Path;
using path::Pose;

namespace {

using Eigen::Vector3d;
using Kind = FollowEvent::Kind;

constexpr double kProgress = 0.05;  // m and rad: less is no progress

std::vector<Knot> knotsOf(const Path& path, std::size_t first, bool loop) {
  std::vector<Knot> knots;
  for (std::size_t i = first; i < path.poses.size(); ++i)
    knots.push_back({path.poses[i], static_cast<int>(i), !loop && i + 1 == path.poses.size()});
  return knots;
}

// The knots from `first` on.
std::vector<Knot> knotsFrom(const DrivenRoute& route, std::size_t first) {
  return {route.knots().begin() + static_cast<long>(first), route.knots().end()};
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
    const Vector3d segment = poses[i + 1].position - poses[i].position;
    const double square = segment.squaredNorm();
    if (square == 0.0) continue;
    const double share = std::clamp((position - poses[i].position).dot(segment) / square, 0.0, 1.0);
    const Vector3d point = poses[i].position + share * segment;
    const double distance = (point - position).norm();
    const bool goes_on = best.next == i && share > 0.0;  // the same stretch: no slack needed
    if (distance >= (goes_on ? least : least - slack)) continue;
    least = distance;
    const double turn = angleBetween(poses[i].yaw, poses[i + 1].yaw);
    best = {{point, poses[i].yaw + share * turn}, share > 0.0 ? i + 1 : i};
  }
  return best;
}

}  // namespace

RouteProgress::RouteProgress(Path path, Join join, const FollowerOptions& options,
                             FollowEvents& events)
    : options_(options),
      events_(events),
      path_(std::move(path)),
      join_(join),
      loop_(options.loop) {}

void RouteProgress::join(const Pose& vehicle) {
  std::vector<Knot> knots{{vehicle}};
  std::size_t first = 0;
  if (join_ == Join::NEAREST) {
    const JoinPoint joined = nearestPoint(path_, vehicle.position, options_.position_tolerance);
    first = joined.next;
    knots.push_back({joined.pose});
  }
  const std::vector<Knot> waypoints = knotsOf(path_, first, loop_);
  knots.insert(knots.end(), waypoints.begin(), waypoints.end());
  const int next = static_cast<int>(first);
  if (first > 0)
    events_.report(Kind::JOINED, next,
                   "joins the path before " + waypointName(next, path_) + ": " +
                       std::to_string(first) + " before it are not driven");
  route_ = std::make_unique<DrivenRoute>(std::move(knots), options_);
  startSegment(0);
}

void RouteProgress::updateRoute() {
  if (route_) route_->update(options_);
}

std::optional<DriveEnd> RouteProgress::advance(const Pose& vehicle, double time) {
  const std::optional<DriveEnd> ending = passWaypoints(vehicle, time);
  return ending ? ending : checkProgress(vehicle, time);
}

std::optional<DriveEnd> RouteProgress::passWaypoints(const Pose& vehicle, double time) {
  const std::size_t most = route_->segments();  // per update: no endless laps round a tiny loop
  for (std::size_t i = 0; i <= most; ++i) {
    const Knot target = route_->knots()[segment_ + 1];
    closest_ = std::min(closest_, (target.pose.position - vehicle.position).norm());
    if (!(target.stop ? isSettled(vehicle, time) : isPassed(vehicle.position))) return {};
    if (target.stop || closest_ <= options_.acceptance_radius) {
      reach(target.waypoint);
    } else {
      if (retry(vehicle, target.waypoint)) return {};
      if (const auto ending = miss(target.waypoint)) return ending;
    }
    if (target.stop && target.last)
      return DriveEnd{FollowState::ARRIVED, DriveStatus::ARRIVED, "arrived at " + currentName()};
    startSegment(segment_ + 1);
  }
  return {};
}

bool RouteProgress::isSettled(const Pose& vehicle, double time) {
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

bool RouteProgress::isPassed(const Vector3d& position) const {
  if (route_->share(segment_, position) >= 1.0) return true;
  if (closest_ > options_.acceptance_radius) return false;
  const double away = (route_->knots()[segment_ + 1].pose.position - position).norm();
  if (away <= options_.position_tolerance) return true;
  if (route_->turnsBack(segment_))
    return away <= std::min(options_.acceptance_radius, 0.5 * options_.pursuit_distance);
  return route_->distance(route_->next(segment_), position) <= route_->distance(segment_, position);
}

// Where the policy is to drive to a missed waypoint again: a new route from `vehicle` on.
bool RouteProgress::retry(const Pose& vehicle, int waypoint) {
  if (waypoint < 0 || options_.missed_waypoint != MissedPolicy::RETRY ||
      retries_ >= options_.max_retries)
    return false;
  ++retries_;
  events_.report(Kind::RETRY, waypoint, passedText(waypoint) + ": tries again");
  std::vector<Knot> knots = knotsFrom(*route_, segment_ + 1);
  knots.insert(knots.begin(), {vehicle});
  route_ = std::make_unique<DrivenRoute>(std::move(knots), options_);
  startSegment(0);
  return true;
}

// By the policy for missed waypoints the drive ends or goes on.
std::optional<DriveEnd> RouteProgress::miss(int waypoint) {
  if (waypoint < 0) return {};
  missed_.push_back(waypoint);
  events_.report(Kind::MISSED, waypoint, passedText(waypoint));
  if (options_.missed_waypoint == MissedPolicy::SKIP) return {};
  return DriveEnd{FollowState::FAILED, DriveStatus::MISSED_WAYPOINT, passedText(waypoint)};
}

std::string RouteProgress::passedText(int waypoint) const {
  return "passed " + waypointName(waypoint, path_) + " at " + std::to_string(closest_) + " m";
}

void RouteProgress::reach(int waypoint) {
  if (waypoint < 0) return;
  events_.report(Kind::REACHED, waypoint, "reached " + waypointName(waypoint, path_));
  if (loop_ && waypoint + 1 == static_cast<int>(path_.poses.size()))
    events_.report(Kind::LAP, waypoint, "a lap is done");
}

void RouteProgress::startSegment(std::size_t segment) {
  segment_ = segment;
  closest_ = std::numeric_limits<double>::infinity();
  at_stop_ = false;
  restartSettling();
  restartProgress();
  appendLap();
  const auto& knots = route_->knots();
  const auto next = std::find_if(knots.begin() + static_cast<long>(segment_) + 1, knots.end(),
                                 [](const Knot& knot) { return knot.waypoint >= 0; });
  current_waypoint_ = next->waypoint;
}

// In a loop there is always a whole lap ahead; what lies behind is dropped.
void RouteProgress::appendLap() {
  if (!loop_ || route_->segments() - segment_ > path_.poses.size()) return;
  std::vector<Knot> knots = knotsFrom(*route_, segment_);
  const std::vector<Knot> lap = knotsOf(path_, 0, loop_);
  knots.insert(knots.end(), lap.begin(), lap.end());
  route_ = std::make_unique<DrivenRoute>(std::move(knots), options_);
  segment_ = 0;
}

std::optional<DriveEnd> RouteProgress::checkProgress(const Pose& vehicle, double time) {
  const RoutePosition on_route = position(vehicle.position);
  const double left = (1.0 - on_route.share) * route_->length(segment_) +
                      (on_route.point() - vehicle.position).norm() +
                      std::abs(angleBetween(vehicle.yaw, wantedYaw(on_route, vehicle, options_)));
  if (!progress_since_ || settled_since_ || left < least_left_ - kProgress) {
    progress_since_ = time;
    least_left_ = left;
  }
  if (options_.no_progress_timeout <= 0.0 || time - *progress_since_ < options_.no_progress_timeout)
    return {};
  return DriveEnd{FollowState::FAILED, DriveStatus::NO_PROGRESS,
                  "no progress for " + decimalText(options_.no_progress_timeout) +
                      " s while driving to " + currentName()};
}

RoutePosition RouteProgress::position(const Vector3d& vehicle) const {
  return {*route_, segment_, std::clamp(route_->share(segment_, vehicle), 0.0, 1.0), at_stop_};
}

std::vector<Vector3d> RouteProgress::ahead(const Vector3d& vehicle, double distance) const {
  const RoutePosition nearest = position(vehicle);
  const Vector3d back = nearest.point() - vehicle;
  const double length = back.norm();
  if (length > distance) return {vehicle, vehicle + back * (distance / length)};
  std::vector<Vector3d> points = route_->piece(segment_, nearest.share, distance);
  points.insert(points.begin(), vehicle);
  return points;
}

// The knot of the last waypoint, of this lap in a loop.
std::size_t RouteProgress::endOfLap() const {
  const auto& knots = route_->knots();
  std::size_t end = segment_ + 1;
  while (end + 1 < knots.size() && knots[end].waypoint + 1 != static_cast<int>(path_.poses.size()))
    ++end;
  return end;
}

double RouteProgress::distanceRemaining(const Vector3d& vehicle) const {
  if (segment_ >= route_->segments()) return 0.0;
  const auto& knots = route_->knots();
  return knots[endOfLap()].s - knots[segment_].s -
         position(vehicle).share * route_->length(segment_);
}

double RouteProgress::timeRemaining(const Vector3d& vehicle) const {
  if (segment_ >= route_->segments()) return 0.0;
  return drivingTime(*route_, segment_, position(vehicle).share, endOfLap(), options_);
}

}  // namespace grid_path_planner::following
