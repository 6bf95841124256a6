#include "ros/driving/motion_gate.h"

#include <algorithm>
#include <memory>
#include <sstream>

#include "vehicle/motion_check.h"

namespace grid_path_planner::nodes {

using base::BodyVelocity;
using following::ClearanceLimits;
using vehicle::Description;

namespace {

constexpr double kLongestPeriod = 0.5;  // s, of ROS time, between two ticks
constexpr double kOldestPose = 1.0;     // s, over which a pose is carried on

std::string sentenceOf(const vehicle::FootprintContact& contact, const grid::OccupancyGrid& map) {
  const Eigen::Vector2d at = map.geometry().centre(contact.cell);
  std::ostringstream text;
  text << "the vehicle would touch " << (map.contains(contact.cell) ? "a cell" : "the border")
       << " of projected_map at x " << at.x() << ", y " << at.y() << " m";
  return text.str();
}

}  // namespace

MotionGate::MotionGate(const Description* vehicle) {
  if (!vehicle) return;
  vehicle_ = *vehicle;
  commanded_.emplace(vehicle_);
}

void MotionGate::tick(double now, double period) {
  if (!checks()) return;
  period_ = std::clamp(now - now_, period, kLongestPeriod);
  now_ = now;
  commanded_->advanceTo(now);
}

void MotionGate::sent(const BodyVelocity& command) {
  if (checks()) commanded_->sent(command);
}

following::MotionCheck MotionGate::check(const path::Pose& pose, double age,
                                         const grid::OccupancyGrid& map,
                                         const ClearanceLimits& limits) const {
  vehicle::PlanarState now{pose.position.head<2>(), pose.yaw, commanded_->velocity()};
  now = alongArc(now, std::clamp(age, 0.0, kOldestPose));
  const auto check = std::make_shared<const vehicle::MotionCheck>(
      vehicle_, map.geometry(),
      vehicle::mapObstacles(map, limits.thresholds, limits.stop_at_unknown),
      vehicle::MovingVehicle{now, commanded_->pending(), period_});
  return [check, &map](const BodyVelocity& command) {
    const auto contact = check->contactOf(command);
    return contact ? sentenceOf(*contact, map) : std::string();
  };
}

}  // namespace grid_path_planner::nodes
