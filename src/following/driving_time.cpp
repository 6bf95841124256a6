#include "following/driving_time.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::following {
namespace {

constexpr double kPiece = 0.1;        // m, of which the speed is taken in the middle
constexpr double kMostPieces = 2000;  // of the whole route

// The share of the speed along a segment with which its steepness is inside the limit upwards.
double steepness(const DrivenRoute& route, std::size_t segment, double speed,
                 const FollowerOptions& options) {
  const Eigen::Vector3d step =
      route.knots()[segment + 1].pose.position - route.knots()[segment].pose.position;
  const double length = step.norm();
  const double upwards = length > 0.0 ? speed * std::abs(step.z()) / length : 0.0;
  return upwards > options.max_vertical_speed ? options.max_vertical_speed / upwards : 1.0;
}

double segmentTime(const DrivenRoute& route, std::size_t segment, double from, double piece,
                   const FollowerOptions& options) {
  const double left = (1.0 - from) * route.length(segment);
  const int pieces = std::max(1, static_cast<int>(std::ceil(left / piece)));
  const double slowest = options.position_gain * options.position_tolerance;  // before a stop
  double time = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double share = from + (1.0 - from) * (i + 0.5) / pieces;
    const double speed = route.speed(segment, share, options);
    time += left / pieces / std::max(slowest, speed * steepness(route, segment, speed, options));
  }
  return time;
}

// By yaw_gain and max_yaw_rate, into the tolerance.
double turningTime(double angle, const FollowerOptions& options) {
  const double slow = options.max_yaw_rate / options.yaw_gain;  // rad, below which the rate falls
  const double fast = std::max(0.0, angle - slow) / options.max_yaw_rate;
  const double rest = std::min(angle, slow);
  return fast + std::max(0.0, std::log(rest / options.yaw_tolerance)) / options.yaw_gain;
}

// What is left to turn at the end: where the vehicle faces along the path, from its last direction.
double turnAtEnd(const DrivenRoute& route, std::size_t end, const FollowerOptions& options) {
  if (options.facing != FacingMode::ALONG) return 0.0;
  const Eigen::Vector3d last = route.point(end - 1, 1.0) - route.point(end - 1, 0.0);
  if (last.head<2>().norm() <= options.position_tolerance) return 0.0;
  return std::abs(angleBetween(std::atan2(last.y(), last.x()), route.knots()[end].pose.yaw));
}

}  // namespace

double drivingTime(const DrivenRoute& route, std::size_t segment, double share, std::size_t end,
                   const FollowerOptions& options) {
  const double whole = route.knots()[end].s - route.knots()[segment].s;
  const double piece = std::max(kPiece, whole / kMostPieces);
  double time = segmentTime(route, segment, share, piece, options);
  for (std::size_t i = segment + 1; i < end; ++i)
    time += segmentTime(route, i, 0.0, piece, options);
  if (!route.knots()[end].stop) return time;
  const double turn = turnAtEnd(route, end, options);
  return time + options.settle_time + (turn > 0.0 ? turningTime(turn, options) : 0.0);
}

}  // namespace grid_path_planner::following
