#include "following/driven_route.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace grid_path_planner::following {
namespace {

using Eigen::Vector3d;

constexpr double kBraking = 0.8;  // share of the acceleration that is planned with
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How far before a corner its rounding begins, in metres.
double cornerLead(const FollowerOptions& options) {
  return 0.5 * options.pursuit_distance;
}

}  // namespace

double angleBetween(double from, double to) {
  return std::remainder(to - from, 2.0 * M_PI);
}

double brakingDeceleration(const FollowerOptions& options) {
  return kBraking * options.max_acceleration;
}

DrivenRoute::DrivenRoute(std::vector<Knot> knots, const FollowerOptions& options)
    : knots_(std::move(knots)) {
  for (std::size_t i = 1; i < knots_.size(); ++i)
    knots_[i].s = knots_[i - 1].s + (knots_[i].pose.position - knots_[i - 1].pose.position).norm();
  update(options);
}

void DrivenRoute::update(const FollowerOptions& options) {
  double stop_s = kInfinity;
  for (std::size_t i = knots_.size(); i-- > 0;) {
    Knot& knot = knots_[i];
    knot.stop = knot.last || (options.mode == FollowMode::STOP_AT_EACH && knot.waypoint >= 0);
    if (knot.stop) stop_s = knot.s;
    knot.stop_s = stop_s;
    knot.corner_speed = knot.stop ? 0.0 : cornerSpeed(i, options);
    knot.speed_beyond = i + 1 < knots_.size() ? speedBefore(i + 1, length(i), options) : kInfinity;
  }
}

double DrivenRoute::speedBefore(std::size_t knot, double distance,
                                const FollowerOptions& options) const {
  const Knot& next = knots_[knot];
  const auto braked = [&](double speed, double metres) {
    return std::sqrt(speed * speed + 2.0 * brakingDeceleration(options) * std::max(0.0, metres));
  };
  const double lead = next.stop ? 0.0 : cornerLead(options);
  return std::min(braked(next.corner_speed, distance - lead), braked(next.speed_beyond, distance));
}

double DrivenRoute::share(std::size_t i, const Vector3d& position) const {
  const Vector3d segment = knots_[i + 1].pose.position - knots_[i].pose.position;
  const double square = segment.squaredNorm();
  return square > 0.0 ? (position - knots_[i].pose.position).dot(segment) / square : 1.0;
}

Vector3d DrivenRoute::point(std::size_t i, double share) const {
  const Vector3d& from = knots_[i].pose.position;
  return from + share * (knots_[i + 1].pose.position - from);
}

double DrivenRoute::distance(std::size_t i, const Vector3d& position) const {
  return (point(i, std::clamp(share(i, position), 0.0, 1.0)) - position).norm();
}

std::size_t DrivenRoute::next(std::size_t i) const {
  for (++i; i + 1 < segments() && length(i) <= 0.0;) ++i;
  return i;
}

bool DrivenRoute::turnsBack(std::size_t i) const {
  return i + 1 < segments() && direction(i).dot(direction(next(i))) < 0.0;
}

Vector3d DrivenRoute::ahead(std::size_t i, double share, double distance) const {
  const Vector3d heading = direction(i);
  double s = knots_[i].s + share * length(i) + distance;
  while (s > knots_[i + 1].s) {
    const bool ends = knots_[i + 1].stop || i + 1 == segments();
    if (ends || direction(i + 1).dot(heading) < 0.0) return knots_[i + 1].pose.position;
    ++i;
  }
  return at(s);
}

std::vector<Vector3d> DrivenRoute::piece(std::size_t i, double share, double distance) const {
  std::vector<Vector3d> points{point(i, share)};
  const double end = knots_[i].s + share * length(i) + distance;
  for (; i < segments() && knots_[i + 1].s < end; ++i)
    points.push_back(knots_[i + 1].pose.position);
  if (i < segments()) points.push_back(at(end));
  return points;
}

double DrivenRoute::speed(std::size_t i, double share, const FollowerOptions& options) const {
  const Knot& next = knots_[i + 1];
  const double left = (1.0 - share) * length(i);
  const double before_stop = options.position_gain * (next.stop_s - next.s + left);
  return std::min({options.max_speed, speedBefore(i + 1, left, options), before_stop});
}

Vector3d DrivenRoute::direction(std::size_t i) const {
  const Vector3d segment = knots_[i + 1].pose.position - knots_[i].pose.position;
  const double size = segment.norm();
  return size > 0.0 ? Vector3d(segment / size) : Vector3d(Vector3d::Zero());
}

Vector3d DrivenRoute::at(double s) const {
  const auto after =
      std::upper_bound(knots_.begin(), knots_.end(), s,
                       [](double value, const Knot& knot) { return value < knot.s; });
  if (after == knots_.begin()) return knots_.front().pose.position;
  if (after == knots_.end()) return knots_.back().pose.position;
  const auto before = after - 1;
  const double part = (s - before->s) / (after->s - before->s);
  return before->pose.position + part * (after->pose.position - before->pose.position);
}

// Rounding a turn of an angle within the pursuit distance takes speed^2 x angle / distance of
// acceleration; where the route turns back, the vehicle must brake inside the acceptance radius.
double DrivenRoute::cornerSpeed(std::size_t knot, const FollowerOptions& options) const {
  const Knot& corner = knots_[knot];
  const Vector3d in = corner.pose.position - at(corner.s - options.pursuit_distance);
  const Vector3d out = at(corner.s + options.pursuit_distance) - corner.pose.position;
  if (in.norm() <= 0.0 || out.norm() <= 0.0) return options.max_speed;
  const double cosine = std::clamp(in.normalized().dot(out.normalized()), -1.0, 1.0);
  const double angle = std::max(std::acos(cosine), 1e-6);
  double square = options.max_acceleration * options.pursuit_distance / angle;
  if (cosine < 0.0)
    square = std::min(square, options.max_acceleration *
                                  std::min(options.acceptance_radius, cornerLead(options)));
  return std::min(options.max_speed, std::sqrt(square));
}

}  // namespace grid_path_planner::following
