#include "ros/input/finished_goals.h"

#include <algorithm>
#include <utility>

#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {
namespace {

// Clocks of nodes differ, most of all those that hear /clock: a goal that is given in answer to an end may be stamped
// before it.
const ros::Duration kClocksDiffer(0.5);

// Goals that are given while /clock stands differ by nanoseconds, and their paths do not.
constexpr double kInstant = 1e-3;  // s

// When the goal of `path` was given; 0: nobody knows. All other poses of a path of path_planner have the stamp of the
// path, those of a trajectory have times of their own.
ros::Time goalTime(const nav_msgs::Path& path, bool may_be_ahead) {
  if (path.poses.empty()) return {};
  const ros::Time& given = path.poses.back().header.stamp;
  const auto is_path_time = [&](const geometry_msgs::PoseStamped& pose) {
    return pose.header.stamp == path.header.stamp;
  };
  const bool others = !std::all_of(path.poses.begin(), path.poses.end() - 1, is_path_time);
  const bool ahead = given > path.header.stamp && !may_be_ahead;
  return others || ahead ? ros::Time() : given;
}

}  // namespace

void FinishedGoals::drive(const nav_msgs::Path& path) {
  driven_ = goalTime(path, went_back_);
}

void FinishedGoals::end() {
  if (!driven_.isZero()) ended_ = std::exchange(driven_, ros::Time());
}

void FinishedGoals::endAllUntil(const ros::Time& now) {
  end();
  if (now.toSec() > kClocksDiffer.toSec())
    until_ = std::max(until_, normalized(now) - kClocksDiffer);
}

void FinishedGoals::timeWentBack() {
  end();
  until_ = ros::TIME_MIN + ros::Duration(0, 1);
  went_back_ = true;
}

bool FinishedGoals::isOver(const nav_msgs::Path& path) const {
  const ros::Time given = goalTime(path, went_back_);
  const bool of_old_time = secondsBetween(path.header.stamp, given) > kInstant;
  return !given.isZero() && (given == ended_ || given < until_ || of_old_time);
}

}  // namespace grid_path_planner::nodes
