// A path and where the vehicle is, as navigate_path drives it: a velocity is always finite.
#include <nav_msgs/Path.h>

#include <cmath>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/following/path_follower.h"
#include "grid_path_planner/ros/conversions.h"

namespace grid_path_planner::fuzz {
namespace {

geometry_msgs::PoseStamped waypointAt(double x, double y) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "map";
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.orientation.w = 1.0;
  return pose;
}

std::vector<std::string> seedsOfPaths() {
  nav_msgs::Path path;
  path.header.frame_id = "map";
  path.poses = {waypointAt(0.0, 0.0), waypointAt(1.0, 0.5), waypointAt(2.0, 0.0)};
  const std::string vehicle = bytesOf(waypointAt(0.1, 0.2).pose.position);
  return {vehicle + bytesOf(path), vehicle + bytesOf(nav_msgs::Path())};
}

void drive(following::PathFollower& follower, const Eigen::Vector3d& position) {
  for (int tick = 0; tick < 20; ++tick) {
    path::Pose pose;
    pose.position = position;
    pose.yaw = 0.3 * tick;
    const base::BodyVelocity velocity = follower.update({0.1 * tick, pose});
    const double all = velocity.surge + velocity.sway + velocity.heave + velocity.yaw_rate;
    mustHold(std::isfinite(all), "the velocity is finite");
  }
}

// The vehicle's position comes from tf, which knows no limits.
FUZZ_TARGET(path_message, seedsOfPaths) {
  const std::size_t at = bytesOf(geometry_msgs::Point()).size();
  if (input.size() < at) return;
  const auto vehicle = messageOf<geometry_msgs::Point>(input.substr(0, at));
  const auto message = messageOf<nav_msgs::Path>(input.substr(at));
  if (!vehicle || !message) return;
  following::PathFollower follower;
  mayRefuse([&] {
    follower.start(nodes::pathFromMessage(*message), following::Join::NEAREST);
    drive(follower, {vehicle->x, vehicle->y, vehicle->z});
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
