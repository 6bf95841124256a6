// A vehicle follows a path: from pose and time to velocity, without ROS.
//
// PathFollower is called at any rate with the time and the vehicle's pose, and answers with the
// velocity to command. Here an ideal vehicle drives exactly as commanded. The events say what
// happened; the check, asked about the path ahead, stops the vehicle before obstacles.
#include <cmath>
#include <iostream>
#include <memory>

#include "grid_path_planner/following/path_follower.h"
#include "grid_path_planner/planning/path_planner.h"
#include "text_map.h"

using grid_path_planner::base::BodyVelocity;
using grid_path_planner::following::DriveStatus;
using grid_path_planner::following::FollowerOptions;
using grid_path_planner::following::FollowEvent;
using grid_path_planner::following::Join;
using grid_path_planner::following::PathFollower;
using grid_path_planner::grid::OccupancyGrid;
using grid_path_planner::path::Pose;
using grid_path_planner::planning::PathPlanner;
using grid_path_planner::planning::PlannerOptions;

namespace {

// Where a vehicle is after `seconds` of this velocity, which is in its own frame.
Pose moved(Pose pose, const BodyVelocity& velocity, double seconds) {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  pose.position.x() += (velocity.surge * c - velocity.sway * s) * seconds;
  pose.position.y() += (velocity.surge * s + velocity.sway * c) * seconds;
  pose.position.z() += velocity.heave * seconds;
  pose.yaw += velocity.yaw_rate * seconds;
  return pose;
}

}  // namespace

int main() {
  const auto map = std::make_shared<const OccupancyGrid>(
      examples::mapOf({"..........", "....#.....", "....#.....", "....#....."}));
  PlannerOptions planning;
  planning.smooth = false;  // all cells are printed
  PathPlanner planner(planning);
  planner.setMap(map);
  Pose vehicle = {{0.5, 0.5, -1.0}, 0.0};
  const auto plan = planner.plan({vehicle, {{9.5, 0.5, -2.0}, M_PI / 2}});
  examples::print(*map, plan.path);

  FollowerOptions options;
  options.max_speed = 1.0;  // m/s
  PathFollower follower(options);
  follower.start(plan.path, Join::NEAREST);

  const double period = 0.05;  // s
  double time = 0.0;
  do {
    const BodyVelocity velocity = follower.update({time, vehicle});
    vehicle = moved(vehicle, velocity, period);
    time += period;
    for (const FollowEvent& event : follower.takeEvents())
      std::cout << "after " << std::round(time) << " s: " << event.message << '\n';
  } while (follower.active() && time < 120.0);

  std::cout << toString(follower.status()) << ": " << follower.message() << '\n'
            << "The vehicle is at x " << std::round(vehicle.position.x() * 10) / 10 << ", y "
            << std::round(vehicle.position.y() * 10) / 10 << ", z "
            << std::round(vehicle.position.z() * 10) / 10 << ".\n";
  return follower.status() == DriveStatus::ARRIVED ? 0 : 1;
}
