#include "following/wheeled_controller.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::following {

using Eigen::Vector2d;
using path::Pose;

namespace {

constexpr double kTurnFirst =
    0.7;  // rad, of a point beyond which a differential drive turns on the spot
constexpr double kTurned = 0.1;        // rad, below which it drives again
constexpr double kBehind = 2.0;        // rad, of a point behind the vehicle
constexpr double kNoMoreBehind = 1.0;  // rad, of one that a car which backs off turns to again
constexpr double kBackwards =
    2.4;  // rad between where a waypoint or the vehicle looks and where the path leads
constexpr double kNoMoreBackwards = 1.8;  // rad, of a vehicle that drives backwards
constexpr double kNearStop =
    0.3;                          // m, within which one that has passed its stop may back off to it
constexpr double kPreview = 0.5;  // s that the point ahead is at least away
constexpr double kBraking = 0.8;  // share of the acceleration that is planned with

Vector2d planar(const Eigen::Vector3d& v) {
  return v.head<2>();
}

double directionOf(const Vector2d& v) {
  return std::atan2(v.y(), v.x());
}

}  // namespace

Steering WheeledController::follow(const RoutePosition& position, const Pose& vehicle,
                                   double seconds, double pursuit) const {
  const Knot& target = position.route.knots()[position.segment + 1];
  if (target.stop && position.at_stop && isThere(target.pose, vehicle))
    return turnBy(angleBetween(vehicle.yaw, target.pose.yaw), last(vehicle), seconds);
  const double along = position.route.speed(position.segment, position.share, options());
  const double ahead = pursuit * std::max(options().pursuit_distance, kPreview * along);
  const Vector2d point = planar(position.route.ahead(position.segment, position.share, ahead));
  const bool stop = target.stop && point == planar(target.pose.position);
  return driveTo({point, std::sqrt(pursuit) * along, stop, pathLeadsBackwards(position, vehicle)},
                 vehicle, seconds);
}

// So near that what is left is to turn: in the middle of the tolerance, or where it would have to turn to come nearer.
bool WheeledController::isThere(const Pose& stop, const Pose& vehicle) const {
  const Vector2d off = planar(stop.position - vehicle.position);
  if (car() || off.norm() > options().position_tolerance) return false;
  return last(vehicle).turning || off.norm() <= 0.5 * options().position_tolerance ||
         std::abs(std::sin(angleBetween(vehicle.yaw, directionOf(off)))) > std::sin(kTurnFirst);
}

Steering WheeledController::holdPose(const Pose& target, const Pose& vehicle,
                                     double seconds) const {
  const Steering before = last(vehicle);
  const double share = before.returning ? 0.5 : 1.0;
  const double turn = angleBetween(vehicle.yaw, target.yaw);
  const Vector2d off = planar(target.position - vehicle.position);
  const bool there = off.norm() <= share * options().position_tolerance;
  if (!options().hold_pose || car() || (there && std::abs(turn) <= share * options().yaw_tolerance))
    return {};
  Steering steering = there ? turnBy(turn, before, seconds)
                            : driveTo({planar(target.position), options().max_speed, true, false},
                                      vehicle, seconds);
  steering.returning = true;
  return steering;
}

// As a path does along which the vehicle backs off: its waypoints look in the other direction, and so does the vehicle.
bool WheeledController::pathLeadsBackwards(const RoutePosition& position,
                                           const Pose& vehicle) const {
  if (vehicle_.max_backward_speed <= 0.0) return false;
  const Pose& from = position.route.knots()[position.segment].pose;
  const Pose& to = position.route.knots()[position.segment + 1].pose;
  const Vector2d along = planar(to.position - from.position);
  if (along.norm() <= 0.0) return false;
  const double direction = directionOf(along);
  const double least = last(vehicle).backwards ? kNoMoreBackwards : kBackwards;
  return std::abs(angleBetween(direction, to.yaw)) > kBackwards &&
         std::abs(angleBetween(direction, vehicle.yaw)) > least;
}

bool WheeledController::goesBackwards(const Aim& aim, double error, double distance,
                                      const Steering& before) const {
  if (vehicle_.max_backward_speed <= 0.0) return false;
  if (aim.backwards) return true;
  const double behind = before.backwards ? kNoMoreBehind : kBehind;
  return std::abs(error) > behind && (car() || (aim.stop && distance < kNearStop));
}

double WheeledController::speedOn(double curvature, const Aim& aim, double distance,
                                  bool backwards) const {
  double speed = std::min({aim.speed, speedLimit(), options().max_speed});
  if (aim.stop)  // whatever is left along the path: a vehicle beside its stop still drives there
    speed = std::min({speedLimit(), options().max_speed, options().position_gain * distance,
                      std::sqrt(2.0 * kBraking * options().max_acceleration * distance)});
  if (backwards) speed = std::min(speed, vehicle_.max_backward_speed);
  const double bend = std::abs(curvature);
  if (bend > 0.0)
    speed = std::min(
        {speed, options().max_yaw_rate / bend, std::sqrt(options().max_acceleration / bend)});
  return speed;
}

// Along the arc that leads through the point.
Steering WheeledController::driveTo(const Aim& aim, const Pose& vehicle, double seconds) const {
  const Steering before = last(vehicle);
  const Vector2d off = aim.point - planar(vehicle.position);
  const double distance = std::max(off.norm(), 1e-3);
  double error = angleBetween(vehicle.yaw, directionOf(off));
  const bool backwards = goesBackwards(aim, error, distance, before);
  if (backwards) error = angleBetween(M_PI, error);
  Steering steering;
  const bool turns = !car() && std::abs(error) > (before.turning ? kTurned : kTurnFirst);
  if (turns) steering = turnBy(error, before, seconds);
  steering.backwards = backwards;
  if (turns) return steering;
  double curvature = 2.0 * std::sin(error) / distance;
  if (car()) {
    const double most = 1.0 / vehicle_.least_turning_radius;
    if (std::abs(error) > M_PI / 2) curvature = std::copysign(most, error);
    curvature = std::clamp(curvature, -most, most);
  }
  const double wanted = speedOn(curvature, aim, distance, backwards);
  const double surge = towards(before.command.surge, backwards ? -wanted : wanted,
                               options().max_acceleration * seconds);
  // The arc of the speed that is commanded now.
  const double rate =
      std::clamp(std::abs(surge) * curvature, -options().max_yaw_rate, options().max_yaw_rate);
  steering.command.surge = surge;
  steering.command.yaw_rate =
      towards(before.command.yaw_rate, rate, options().max_yaw_acceleration * seconds);
  steering.velocity = base::inMap(steering.command, vehicle.yaw);
  steering.yaw = vehicle.yaw;
  return steering;
}

Steering WheeledController::turnBy(double error, Steering before, double seconds) const {
  Steering steering;
  steering.command.surge = towards(before.command.surge, 0.0, options().max_acceleration * seconds);
  steering.command.yaw_rate = towards(before.command.yaw_rate, yawRateFor(error, options()),
                                      options().max_yaw_acceleration * seconds);
  steering.turning = true;
  return steering;
}

}  // namespace grid_path_planner::following
