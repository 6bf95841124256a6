#include "ros/common/incoming/given_goals.h"

#include <utility>

namespace grid_path_planner::nodes {
namespace {

// When the goal of `path` was given; 0: nobody knows.
ros::Time goalTime(const nav_msgs::Path& path) {
  return path.poses.empty() ? ros::Time() : path.poses.back().header.stamp;
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
  until_ = now;
}

void GivenGoals::forget() {
  *this = GivenGoals();
}

bool GivenGoals::isOver(const nav_msgs::Path& path) const {
  const ros::Time given = goalTime(path);
  return !given.isZero() && (given == ended_ || given <= until_);
}

}  // namespace grid_path_planner::nodes
