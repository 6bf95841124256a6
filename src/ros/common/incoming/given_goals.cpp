#include "ros/common/incoming/given_goals.h"

#include <utility>

namespace grid_path_planner::nodes {
namespace {

// Clocks of nodes differ, most of all those that hear /clock: a goal that is given in answer to an end may be stamped
// before it.
const ros::Duration kClocksDiffer(0.5);

// When the goal of `path` was given; 0: nobody knows. All other poses of a path of path_planner have the stamp of the
// path, those of a trajectory have times of their own.
ros::Time goalTime(const nav_msgs::Path& path) {
  if (path.poses.empty()) return {};
  const ros::Time& given = path.poses.back().header.stamp;
  const bool others = path.poses.size() > 1 && path.poses.front().header.stamp != path.header.stamp;
  return others || given > path.header.stamp ? ros::Time() : given;
}

}  // namespace

void GivenGoals::drive(const nav_msgs::Path& path) {
  driven_ = goalTime(path);
}

void GivenGoals::end() {
  if (!driven_.isZero()) ended_ = std::exchange(driven_, ros::Time());
}

void GivenGoals::endAllUntil(const ros::Time& now) {
  end();
  until_ = now.toSec() > kClocksDiffer.toSec() ? now - kClocksDiffer : ros::Time();
}

void GivenGoals::forget() {
  *this = GivenGoals();
}

bool GivenGoals::isOver(const nav_msgs::Path& path) const {
  const ros::Time given = goalTime(path);
  return !given.isZero() && (given == ended_ || given < until_);
}

}  // namespace grid_path_planner::nodes
