#include <geometry_msgs/Twist.h>

#include <cmath>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/simulation/vehicle.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfTwists() {
  geometry_msgs::Twist fast;
  fast.linear.x = 1e9;
  fast.angular.z = -0.5;
  return {bytesOf(fast) + bytesOf(geometry_msgs::Twist())};
}

// Several commands one after the other, to a vehicle between obstacles.
FUZZ_TARGET(twist_message, seedsOfTwists) {
  static const auto map = [] {
    auto cells = std::make_shared<grid::OccupancyGrid>(grid::GridGeometry(20, 20, 0.25));
    (*cells)[{14, 10}] = 100;
    return cells;
  }();
  const std::size_t size = bytesOf(geometry_msgs::Twist()).size();
  simulation::Vehicle vehicle({}, {Eigen::Vector3d(2.5, 2.5, -1.0), 0.0});
  vehicle.setMap(map);
  for (std::size_t at = 0; at + size <= std::min<std::size_t>(input.size(), 16 * size);
       at += size) {
    const auto twist = messageOf<geometry_msgs::Twist>(input.substr(at, size));
    mayRefuse([&] {
      vehicle.command({twist->linear.x, twist->linear.y, twist->linear.z, twist->angular.z});
    });
    for (int step = 0; step < 3; ++step) vehicle.step();
    mustHold(vehicle.state().position.allFinite() && std::isfinite(vehicle.state().yaw),
             "the vehicle is somewhere");
  }
}

}  // namespace
}  // namespace grid_path_planner::fuzz
