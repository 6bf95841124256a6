#include "support/path_checker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace grid_path_planner::test {

using grid::Cell;
using grid::Grid;
using grid::Occupancy;
using grid::OccupancyGrid;
using path::Path;
using path::Pose;

namespace {

constexpr double kSamePlace = 1e-9;  // metres

struct Segment {
  Eigen::Vector2d from, to;
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Whether the segment meets the inside of the box: it does unless some line separates them, and if
// any does, then one along the x axis, the y axis or the segment.
bool meetsInside(const Segment& s, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  for (int axis = 0; axis < 2; ++axis)
    if (std::max(s.from[axis], s.to[axis]) <= low[axis] ||
        std::min(s.from[axis], s.to[axis]) >= high[axis])
      return false;
  const Eigen::Vector2d along = s.to - s.from;
  if (along.isZero(0.0)) return true;
  int left = 0, right = 0;
  for (const Eigen::Vector2d& corner :
       {low, high, Eigen::Vector2d(low.x(), high.y()), Eigen::Vector2d(high.x(), low.y())}) {
    const double side = cross(along, corner - s.from);
    left += side > 0.0;
    right += side < 0.0;
  }
  return left > 0 && right > 0;
}

double distance(const Segment& s, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = s.to - s.from;
  const double length = along.norm();
  const double t = length > 0.0 ? along.dot(point - s.from) / (length * length) : 0.0;
  return (s.from + std::min(1.0, std::max(0.0, t)) * along - point).norm();
}

// Which cells may not be touched.
class Blocked {
 public:
  Blocked(const OccupancyGrid& map, const PathRules& rules) : blocked_(map.geometry(), false) {
    for (int row = 0; row < map.height(); ++row)
      for (int column = 0; column < map.width(); ++column) {
        const Cell cell{column, row};
        const Occupancy occupancy = rules.thresholds.classify(map[cell]);
        if (occupancy == Occupancy::OCCUPIED) {
          blockAround(cell, rules.radius / map.geometry().resolution());
          if (!rules.occupied_is_passable) blocked_[cell] = true;
        }
        if (occupancy == Occupancy::UNKNOWN && !rules.unknown_is_passable) blocked_[cell] = true;
      }
  }

  bool operator()(int column, int row) const {
    return !blocked_.contains({column, row}) || blocked_[Cell{column, row}];
  }

 private:
  // The cells whose centres are nearer to the edge of an occupied one than `radius` cells.
  void blockAround(Cell occupied, double radius) {
    const int reach = static_cast<int>(std::ceil(radius)) + 1;
    for (int dr = -reach; dr <= reach; ++dr)
      for (int dc = -reach; dc <= reach; ++dc) {
        const double dx = std::max(0.0, std::abs(dc) - 0.5), dy = std::max(0.0, std::abs(dr) - 0.5);
        const Cell cell{occupied.column + dc, occupied.row + dr};
        if (blocked_.contains(cell) && std::hypot(dx, dy) < radius - 1e-9) blocked_[cell] = true;
      }
  }

  Grid<char> blocked_;
};

// Asks `ask` about every cell around the segment (cell units) until one gives an answer.
template <class Ask>
std::string firstAnswer(const Segment& s, const Ask& ask) {
  const Eigen::Vector2d low = s.from.cwiseMin(s.to).array().floor();
  const Eigen::Vector2d high = s.from.cwiseMax(s.to).array().floor();
  for (int row = static_cast<int>(low.y()) - 1; row <= high.y() + 1; ++row)
    for (int column = static_cast<int>(low.x()) - 1; column <= high.x() + 1; ++column) {
      const std::string answer = ask(column, row);
      if (answer.empty()) continue;
      std::ostringstream text;
      text << answer << ' ' << Cell{column, row};
      return text.str();
    }
  return "";
}

// The first thing that is wrong with a segment in cell units; empty if nothing is. `ends`: of the
// whole path.
std::string segmentViolation(const Segment& s, const Segment& ends, const Blocked& blocked,
                             const PathRules& rules) {
  // The cell and its neighbours right and above, as one block without its rim.
  const auto meets = [&](int column, int row, int width, int height) {
    const Eigen::Vector2d low(column, row), rim(rules.slack, rules.slack);
    return meetsInside(s, low + rim, low + Eigen::Vector2d(width, height) - rim);
  };
  const std::string inside = firstAnswer(s, [&](int column, int row) {
    return blocked(column, row) && meets(column, row, 1, 1) ? "meets the blocked cell" : "";
  });
  if (!inside.empty()) return inside;
  const std::string between = firstAnswer(s, [&](int column, int row) {
    if (!blocked(column, row)) return "";
    if (blocked(column + 1, row) && meets(column, row, 2, 1))
      return "runs between blocked cells, right of";
    if (blocked(column, row + 1) && meets(column, row, 1, 2))
      return "runs between blocked cells, above";
    return "";
  });
  if (!between.empty() || rules.cut_corners) return between;
  return firstAnswer(s, [&](int column, int row) {
    const bool here = blocked(column, row), right = blocked(column + 1, row);
    const bool above = blocked(column, row + 1), beyond = blocked(column + 1, row + 1);
    const bool pair = here != right && here != above && here == beyond;
    const Eigen::Vector2d point(column + 1, row + 1);
    const double near = M_SQRT2 * rules.slack;
    const bool end = distance({ends.from, ends.from}, point) < near ||
                     distance({ends.to, ends.to}, point) < near;
    return pair && !end && distance(s, point) < near
               ? "squeezes between a diagonal pair at the upper right corner of"
               : "";
  });
}

std::string describe(const Eigen::Vector3d& position) {
  std::ostringstream text;
  text.precision(17);
  text << '(' << position.x() << ", " << position.y() << ')';
  return text.str();
}

bool samePlace(const Pose& a, const Pose& b) {
  return (a.position - b.position).head<2>().norm() < kSamePlace;
}

void checkPoses(const Path& path, const Pose& start, const Pose& goal,
                std::vector<std::string>& violations) {
  const auto say = [&](const std::string& text) { violations.push_back(text); };
  const Pose &first = path.poses.front(), &last = path.poses.back();
  if (!samePlace(first, start))
    say("the first pose " + describe(first.position) + " is not the start " +
        describe(start.position));
  if (!samePlace(last, goal))
    say("the last pose " + describe(last.position) + " is not the goal " + describe(goal.position));
  if (!(std::abs(std::remainder(last.yaw - goal.yaw, 2 * M_PI)) < 1e-9))
    say("the last yaw " + std::to_string(last.yaw) + " is not the goal's " +
        std::to_string(goal.yaw));
  const bool turn_in_place = path.poses.size() == 2 && samePlace(start, goal) &&
                             (start.yaw != goal.yaw || start.position.z() != goal.position.z());
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const Pose& pose = path.poses[i];
    if (!pose.position.allFinite() || !std::isfinite(pose.yaw))
      say("pose " + std::to_string(i) + " is not finite");
    if (i > 0 && !turn_in_place && samePlace(pose, path.poses[i - 1]))
      say("poses " + std::to_string(i - 1) + " and " + std::to_string(i) + " coincide at " +
          describe(pose.position));
  }
}

}  // namespace

std::vector<std::string> pathViolations(const Path& path, const Pose& start, const Pose& goal,
                                        const OccupancyGrid& map, const PathRules& rules) {
  if (path.empty()) return {"the path has no poses"};
  std::vector<std::string> violations;
  checkPoses(path, start, goal, violations);
  const Blocked blocked(map, rules);
  const auto inCells = [&](const Pose& pose) -> Eigen::Vector2d {
    return map.geometry().gridFromWorld(pose.position.head<2>());
  };
  const Segment ends = {inCells(path.poses.front()), inCells(path.poses.back())};
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const Eigen::Vector2d from = inCells(path.poses[i == 0 ? 0 : i - 1]);
    const Eigen::Vector2d to = inCells(path.poses[i]);
    if (!from.allFinite() || !to.allFinite()) continue;  // told above
    const std::string text = segmentViolation({from, to}, ends, blocked, rules);
    if (text.empty()) continue;
    violations.push_back("the segment to pose " + std::to_string(i) + " " + text);
  }
  return violations;
}

}  // namespace grid_path_planner::test
