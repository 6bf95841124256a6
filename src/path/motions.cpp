#include "path/motions.h"

#include <cmath>

namespace grid_path_planner::path {

using vehicle::Motion;

namespace {

// So near to half a circle a vehicle whose heading is measured may turn to either side.
constexpr double kEitherSide = 0.1;
// Directions that differ by less are one straight line, as for HeadingMode::FORWARD_THEN_INTERPOLATE.
constexpr double kOneDirection = 1e-6;

Eigen::Vector2d alongOf(const Path& path, std::size_t i) {
  return (path.poses[i + 1].position - path.poses[i].position).head<2>();
}

double angleOf(const Eigen::Vector2d& along) {
  return std::atan2(along.y(), along.x());
}

// In (-pi, pi], as headings.cpp turns.
double shorterTurn(double from, double to) {
  const double turn = std::remainder(to - from, 2.0 * M_PI);
  return turn <= -M_PI ? M_PI : turn;
}

// The first segment of the straight line that ends at the goal.
std::size_t lastStretch(const Path& path) {
  std::size_t first = path.poses.size() - 1;
  std::optional<double> direction;
  for (std::size_t i = first; i-- > 0;) {
    const Eigen::Vector2d along = alongOf(path, i);
    if (along.isZero(0.0)) continue;
    if (direction && std::abs(shorterTurn(angleOf(along), *direction)) >= kOneDirection) break;
    direction = angleOf(along);
    first = i;
  }
  return first;
}

class Motions {
 public:
  Motions(const Path& path, HeadingMode mode)
      : path_(path),
        mode_(mode),
        turning_from_(mode == HeadingMode::INTERPOLATE                ? 0
                      : mode == HeadingMode::FORWARD_THEN_INTERPOLATE ? lastStretch(path)
                                                                      : path.poses.size()) {}

  std::vector<Motion> along(std::optional<double> start_yaw, std::optional<double> goal_yaw) {
    yaw_ = start_yaw;
    for (std::size_t i = 0; i + 1 < path_.poses.size(); ++i)
      if (!alongOf(path_, i).isZero(0.0)) drive(i);
    const std::size_t last = path_.poses.size() - 1;
    if (goal_yaw) turnTo(*goal_yaw, last);
    if (motions_.empty()) add(last, last, yaw_.value_or(path_.poses[last].yaw), 0.0);
    return std::move(motions_);
  }

 private:
  Eigen::Vector2d at(std::size_t pose) const { return path_.poses[pose].position.head<2>(); }

  void add(std::size_t from, std::size_t to, double yaw, double turn) {
    motions_.push_back({at(from), at(to), yaw, turn, from});
    yaw_ = yaw + turn;
  }

  void turnTo(double yaw, std::size_t pose) {
    const double before = yaw_.value_or(yaw);
    const double turn = shorterTurn(before, yaw);
    if (turn == 0.0) return;
    if (std::abs(turn) > M_PI - kEitherSide)
      add(pose, pose, before, turn - std::copysign(2.0 * M_PI, turn));
    add(pose, pose, before, turn);
    yaw_ = yaw;
  }

  void drive(std::size_t i) {
    const bool turning = i >= turning_from_;
    const double yaw = mode_ == HeadingMode::NONE ? angleOf(alongOf(path_, i)) : path_.poses[i].yaw;
    turnTo(yaw, i);
    add(i, i + 1, yaw, turning ? shorterTurn(yaw, path_.poses[i + 1].yaw) : 0.0);
  }

  const Path& path_;
  const HeadingMode mode_;
  const std::size_t turning_from_;  // from this segment on the heading changes while driving
  std::optional<double> yaw_;
  std::vector<Motion> motions_;
};

}  // namespace

std::optional<double> drivingDirection(double yaw, HeadingMode mode) {
  switch (mode) {
    case HeadingMode::INTERPOLATE:
      return std::nullopt;
    case HeadingMode::BACKWARD:
      return yaw + M_PI;
    case HeadingMode::LEFTWARD:
      return yaw + M_PI / 2;
    case HeadingMode::RIGHTWARD:
      return yaw - M_PI / 2;
    default:
      return yaw;
  }
}

std::vector<Motion> motionsAlong(const Path& path, std::optional<double> start_yaw,
                                 std::optional<double> goal_yaw, HeadingMode mode) {
  if (path.empty()) return {};
  return Motions(path, mode).along(start_yaw, goal_yaw);
}

}  // namespace grid_path_planner::path
