// A follower that drives a simulated vehicle, without ROS and without waiting.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "grid_path_planner/following/path_follower.h"
#include "grid_path_planner/simulation/vehicle.h"
#include "vehicle/description.h"

namespace grid_path_planner::test {

inline path::Path pathOf(const std::vector<std::vector<double>>& poses) {
  path::Path path;
  for (const auto& p : poses)
    path.poses.push_back(
        {Eigen::Vector3d(p.at(0), p.at(1), p.size() > 2 ? p[2] : 0.0), p.size() > 3 ? p[3] : 0.0});
  return path;
}

inline double distanceTo(const path::Path& path, const Eigen::Vector3d& position) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const Eigen::Vector3d a = path.poses[i].position;
    const Eigen::Vector3d segment = path.poses[std::min(i + 1, path.poses.size() - 1)].position - a;
    const double square = segment.squaredNorm();
    const double share =
        square > 0.0 ? std::clamp((position - a).dot(segment) / square, 0.0, 1.0) : 0.0;
    least = std::min(least, (a + share * segment - position).norm());
  }
  return least;
}

struct ClosedLoop {
  explicit ClosedLoop(const following::FollowerOptions& options = {},
                      const Eigen::Vector3d& at = {0, 0, 0}, double yaw = 0.0)
      : follower(pushable(options)), vehicle({}, {at, yaw, {}}) {}
  ClosedLoop(const following::FollowerOptions& options, const vehicle::Description& described,
             const simulation::VehicleOptions& simulated, const Eigen::Vector3d& at, double yaw)
      : follower(options, &described), vehicle(simulated, {at, yaw, {}}) {}

  // A current may take it anywhere.
  static following::FollowerOptions pushable(following::FollowerOptions options) {
    options.pose_jump = 0.0;
    options.hold_distance = 100.0;
    return options;
  }

  path::Pose pose() const { return {vehicle.state().position + pushed, vehicle.state().yaw}; }
  double speed() const {
    const base::BodyVelocity& v = vehicle.state().velocity;
    return std::sqrt(v.surge * v.surge + v.sway * v.sway + v.heave * v.heave);
  }

  // A current takes the vehicle there.
  void putAt(const Eigen::Vector3d& position) { pushed = position - vehicle.state().position; }

  // One control step of 0.05 s.
  void step() {
    following::FollowInput input{vehicle.time(), pose(), check, speed_limit, motion};
    if (!pose_known) input.pose.reset();
    command = follower.update(input);
    vehicle.command(command);
    for (int i = 0; i < 5; ++i) vehicle.step();
    for (following::FollowEvent& event : follower.takeEvents()) events.push_back(std::move(event));
  }

  // Until `condition`, at most `seconds`; whether it came true.
  bool runUntil(const std::function<bool()>& condition, double seconds = 600.0) {
    for (const double end = vehicle.time() + seconds; vehicle.time() < end;) {
      if (condition()) return true;
      step();
      if (each_step) each_step();
    }
    return condition();
  }
  bool runUntilState(following::FollowState state, double seconds = 600.0) {
    return runUntil([&] { return follower.state() == state; }, seconds);
  }
  void run(double seconds) {
    runUntil([] { return false; }, seconds);
  }

  std::vector<int> waypointsOf(following::FollowEvent::Kind kind) const {
    std::vector<int> waypoints;
    for (const following::FollowEvent& event : events)
      if (event.kind == kind) waypoints.push_back(event.waypoint);
    return waypoints;
  }

  following::PathFollower follower;
  simulation::Vehicle vehicle;
  Eigen::Vector3d pushed = Eigen::Vector3d::Zero();
  following::PathClearanceCheck check;
  following::SpeedLimitCheck speed_limit;
  following::MotionCheck motion;
  bool pose_known = true;
  std::function<void()> each_step;
  base::BodyVelocity command;
  std::vector<following::FollowEvent> events;
};

}  // namespace grid_path_planner::test
