#include "grid_path_planner/simulation/moving_bodies.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::simulation {

using base::InputError;
using Eigen::Vector3d;

namespace {

constexpr double kNoRange = std::numeric_limits<double>::infinity();

void checkBody(const MovingBody& body) {
  if (!body.half_size.allFinite() || !(body.half_size.minCoeff() > 0.0))
    throw InputError(body.name + ": sizes of a moving body must be above 0 and finite");
  if (body.track.empty()) throw InputError(body.name + ": a moving body without a position");
  double before = -kNoRange;
  for (const TimedPosition& at : body.track) {
    if (!std::isfinite(at.time) || !at.position.allFinite() || !(at.time > before))
      throw InputError(body.name + ": times of a moving body must rise, and all be finite, got " +
                       std::to_string(at.time) + " s");
    before = at.time;
  }
}

double boundingRadius(const MovingBody& body) {
  if (body.shape == BodyShape::SPHERE) return body.half_size.x();
  if (body.shape == BodyShape::BOX) return body.half_size.norm();
  return std::hypot(body.half_size.x(), body.half_size.z());
}

// The point of a body about the origin that is nearest to p; p itself inside.
Vector3d nearestPoint(const MovingBody& body, const Vector3d& p) {
  const Vector3d& half = body.half_size;
  if (body.shape == BodyShape::BOX) return p.cwiseMin(half).cwiseMax(-half);
  const double radius = half.x();
  if (body.shape == BodyShape::SPHERE) return p.norm() > radius ? radius * p.normalized() : p;
  const double radial = p.head<2>().norm();
  const double share = radial > radius ? radius / radial : 1.0;
  return {share * p.x(), share * p.y(), std::clamp(p.z(), -half.z(), half.z())};
}

// Where a line is inside of something: from `enter` to `leave`; nowhere where enter > leave.
struct Inside {
  double enter = -kNoRange;
  double leave = kNoRange;

  void cut(const Inside& other) {
    enter = std::max(enter, other.enter);
    leave = std::min(leave, other.leave);
  }
  double range() const { return enter <= leave && leave >= 0.0 ? std::max(0.0, enter) : kNoRange; }
};

Inside insideSlab(double at, double direction, double half) {
  if (direction == 0.0) return std::abs(at) <= half ? Inside{} : Inside{1.0, 0.0};
  const double a = (-half - at) / direction, b = (half - at) / direction;
  return {std::min(a, b), std::max(a, b)};
}

// Of a t^2 + 2 b t + c <= 0 with a >= 0: a ball, or a cylinder without ends.
Inside insideRound(double a, double b, double c) {
  if (a == 0.0) return c <= 0.0 ? Inside{} : Inside{1.0, 0.0};
  const double root = b * b - a * c;
  if (root < 0.0) return {1.0, 0.0};
  return {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a};
}

// `origin` in the frame of the body.
double rangeOf(const MovingBody& body, const Vector3d& origin, const Vector3d& direction) {
  const Vector3d& half = body.half_size;
  const double square = half.x() * half.x();
  Inside inside;
  if (body.shape == BodyShape::SPHERE)
    return insideRound(direction.squaredNorm(), origin.dot(direction),
                       origin.squaredNorm() - square)
        .range();
  if (body.shape == BodyShape::BOX) {
    for (int axis = 0; axis < 2; ++axis)
      inside.cut(insideSlab(origin[axis], direction[axis], half[axis]));
  } else {
    inside =
        insideRound(direction.head<2>().squaredNorm(), origin.head<2>().dot(direction.head<2>()),
                    origin.head<2>().squaredNorm() - square);
  }
  inside.cut(insideSlab(origin.z(), direction.z(), half.z()));
  return inside.range();
}

}  // namespace

const std::vector<std::pair<const char*, BodyShape>>& choicesOf(BodyShape) {
  static const std::vector<std::pair<const char*, BodyShape>> choices = {
      {"sphere", BodyShape::SPHERE}, {"cylinder", BodyShape::CYLINDER}, {"box", BodyShape::BOX}};
  return choices;
}

Vector3d MovingBody::positionAt(double time) const {
  const auto after = std::find_if(track.begin(), track.end(),
                                  [time](const TimedPosition& at) { return at.time > time; });
  if (after == track.begin()) return track.front().position;
  if (after == track.end()) return track.back().position;
  const TimedPosition& before = *(after - 1);
  const double share = (time - before.time) / (after->time - before.time);
  return before.position + share * (after->position - before.position);
}

BodiesAt::BodiesAt(const std::vector<MovingBody>& bodies, double time) {
  for (const MovingBody& body : bodies)
    bodies_.push_back({&body, body.positionAt(time), boundingRadius(body)});
}

std::optional<NearestSurface> BodiesAt::nearest(const Vector3d& from, double reach) const {
  std::optional<NearestSurface> best;
  for (const Placed& placed : bodies_) {
    const Vector3d point = placed.centre + nearestPoint(*placed.body, from - placed.centre);
    const double distance = (point - from).norm();
    if (distance < (best ? best->distance : reach))
      best = NearestSurface{distance, point, placed.body->name};
  }
  return best;
}

double BodiesAt::range(const Vector3d& origin, const Vector3d& direction) const {
  double nearest = kNoRange;
  for (const Placed& placed : bodies_) {
    const Vector3d to = placed.centre - origin;
    const double along = to.dot(direction);
    const double beside = to.squaredNorm() - along * along;
    if (beside > placed.bounding_radius * placed.bounding_radius) continue;
    nearest = std::min(nearest, rangeOf(*placed.body, -to, direction));
  }
  return nearest;
}

MovingBodies::MovingBodies(std::vector<MovingBody> bodies) : bodies_(std::move(bodies)) {
  for (const MovingBody& body : bodies_) checkBody(body);
}

}  // namespace grid_path_planner::simulation
