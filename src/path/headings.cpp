#include "grid_path_planner/path/headings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace grid_path_planner::path {
namespace {

// Two segments whose directions differ by less belong to one straight stretch, in radians.
constexpr double kStraight = 1e-6;

Eigen::Vector2d segmentOf(const Path& path, std::size_t i) {
  return (path.poses[i + 1].position - path.poses[i].position).head<2>();
}

double normalised(double angle) {
  return std::remainder(angle, 2.0 * M_PI);
}

// The turn from one yaw to another in (-pi, pi].
double turnBetween(double from, double to) {
  const double turn = normalised(to - from);
  return turn <= -M_PI ? M_PI : turn;
}

// How far along the path every pose is, from 0 to 1: by length, or by number where there is none.
std::vector<double> progressOf(const Path& path) {
  const std::size_t count = path.poses.size();
  std::vector<double> progress(count, 0.0);
  for (std::size_t i = 1; i < count; ++i)
    progress[i] = progress[i - 1] + segmentOf(path, i - 1).norm();
  const double length = progress.back();
  for (std::size_t i = 0; i < count; ++i)
    progress[i] = length > 0.0 ? progress[i] / length
                               : static_cast<double>(i) / std::max<std::size_t>(count - 1, 1);
  return progress;
}

// The direction of the next segment that has a length, at every pose; `at_end` where none is left.
std::vector<double> directionsOf(const Path& path, double at_end) {
  std::vector<double> directions(path.poses.size(), at_end);
  for (std::size_t i = path.poses.size() - 1; i-- > 0;) {
    const Eigen::Vector2d segment = segmentOf(path, i);
    directions[i] = segment.isZero(0.0) ? directions[i + 1] : std::atan2(segment.y(), segment.x());
  }
  return directions;
}

// The last pose whose position differs from the end's; 0 where all coincide.
std::size_t lastBeforeEnd(const Path& path) {
  std::size_t i = path.poses.size() - 1;
  while (i > 0 && segmentOf(path, i - 1).isZero(0.0)) --i;
  return i > 0 ? i - 1 : 0;
}

double offsetOf(HeadingMode mode) {
  switch (mode) {
    case HeadingMode::BACKWARD:
      return M_PI;
    case HeadingMode::LEFTWARD:
      return -M_PI / 2;
    case HeadingMode::RIGHTWARD:
      return M_PI / 2;
    default:
      return 0.0;
  }
}

void faceAlongPath(Path& path, double goal_yaw, double offset) {
  const std::vector<double> directions = directionsOf(path, goal_yaw - offset);
  for (std::size_t i = 0; i < path.poses.size(); ++i)
    path.poses[i].yaw = normalised(directions[i] + offset);
}

void turnByLength(Path& path, double start_yaw, double goal_yaw) {
  const double turn = turnBetween(start_yaw, goal_yaw);
  const std::vector<double> progress = progressOf(path);
  for (std::size_t i = 0; i < path.poses.size(); ++i)
    path.poses[i].yaw = normalised(start_yaw + turn * progress[i]);
}

void turnOverTheLastStretch(Path& path, double goal_yaw) {
  const std::size_t last = lastBeforeEnd(path);
  const double direction = path.poses[last].yaw;
  std::size_t first = last;
  while (first > 0 && std::abs(turnBetween(path.poses[first - 1].yaw, direction)) < kStraight)
    --first;
  Path stretch;
  stretch.poses.assign(path.poses.begin() + first, path.poses.end());
  turnByLength(stretch, direction, goal_yaw);
  std::copy(stretch.poses.begin(), stretch.poses.end(), path.poses.begin() + first);
}

}  // namespace

const std::vector<std::pair<const char*, HeadingMode>>& choicesOf(HeadingMode) {
  static const std::vector<std::pair<const char*, HeadingMode>> choices = {
      {"none", HeadingMode::NONE},
      {"forward", HeadingMode::FORWARD},
      {"interpolate", HeadingMode::INTERPOLATE},
      {"forward_then_interpolate", HeadingMode::FORWARD_THEN_INTERPOLATE},
      {"backward", HeadingMode::BACKWARD},
      {"leftward", HeadingMode::LEFTWARD},
      {"rightward", HeadingMode::RIGHTWARD}};
  return choices;
}

void applyHeadings(Path& path, double start_yaw, double goal_yaw, HeadingMode mode) {
  if (path.empty()) return;
  switch (mode) {
    case HeadingMode::NONE:
      for (Pose& pose : path.poses) pose.yaw = 0.0;
      break;
    case HeadingMode::INTERPOLATE:
      turnByLength(path, start_yaw, goal_yaw);
      break;
    case HeadingMode::FORWARD_THEN_INTERPOLATE:
      faceAlongPath(path, goal_yaw, 0.0);
      turnOverTheLastStretch(path, goal_yaw);
      break;
    case HeadingMode::FORWARD:
    case HeadingMode::BACKWARD:
    case HeadingMode::LEFTWARD:
    case HeadingMode::RIGHTWARD:
      faceAlongPath(path, goal_yaw, offsetOf(mode));
      break;
  }
  path.poses.back().yaw = goal_yaw;
}

double arrivalYaw(const Path& path, double start_yaw, HeadingMode mode) {
  if (mode == HeadingMode::NONE) return 0.0;
  const std::size_t last = lastBeforeEnd(path);
  if (mode == HeadingMode::INTERPOLATE || last + 1 == path.poses.size()) return start_yaw;
  const Eigen::Vector2d segment = segmentOf(path, last);
  if (segment.isZero(0.0)) return start_yaw;
  return normalised(std::atan2(segment.y(), segment.x()) + offsetOf(mode));
}

void lookAlongPath(Path& path) {
  const auto has_none = [](const Pose& pose) { return std::isnan(pose.yaw); };
  if (std::none_of(path.poses.begin(), path.poses.end(), has_none)) return;
  Path along = path;
  applyHeadings(along, 0.0, arrivalYaw(path, 0.0, HeadingMode::FORWARD), HeadingMode::FORWARD);
  for (std::size_t i = 0; i < path.poses.size(); ++i)
    if (has_none(path.poses[i])) path.poses[i].yaw = along.poses[i].yaw;
}

const std::vector<std::pair<const char*, PathZ>>& choicesOf(PathZ) {
  static const std::vector<std::pair<const char*, PathZ>> choices = {
      {"interpolate", PathZ::INTERPOLATE},
      {"start", PathZ::START},
      {"goal", PathZ::GOAL},
      {"fixed", PathZ::FIXED}};
  return choices;
}

void applyZ(Path& path, double start_z, double goal_z, double fixed_z, PathZ mode) {
  if (path.empty()) return;
  if (mode == PathZ::INTERPOLATE) {
    const std::vector<double> progress = progressOf(path);
    for (std::size_t i = 0; i < path.poses.size(); ++i)
      path.poses[i].position.z() = start_z + (goal_z - start_z) * progress[i];
    path.poses.back().position.z() = goal_z;
    return;
  }
  const double z = mode == PathZ::START ? start_z : mode == PathZ::GOAL ? goal_z : fixed_z;
  for (Pose& pose : path.poses) pose.position.z() = z;
}

}  // namespace grid_path_planner::path
