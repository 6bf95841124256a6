#include "grid_path_planner/simulation/vehicle.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grid_path_planner/base/decimal_text.h"
#include "simulation/obstacle_distance.h"
#include "simulation/swept_sphere.h"
#include "vehicle/map_obstacles.h"
#include "vehicle/outline.h"

namespace grid_path_planner::simulation {

using base::BodyVelocity;
using base::decimalText;
using base::InputError;
using grid::OccupancyGrid;
using vehicle::Footprint, vehicle::FootprintSweep, vehicle::Motion;

namespace {

constexpr double kContactEnds = 1e-3;  // m, beyond the vehicle's radius
constexpr double kTouch = 1e-9;        // m, below which two lengths are the same
constexpr int kContactHalvings = 40;   // of the piece in which a contact begins
constexpr double kFootprintShare =
    1e-4;                           // of a step's motion, to which a footprint's contact is found
constexpr double kMostCells = 1e8;  // that one step looks at: a fraction of a second

std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}

// `share` of the difference to the target, with a limit.
double towards(double value, double target, double share, double largest_change) {
  return value + std::clamp(share * (target - value), -largest_change, largest_change);
}

double normalized(double angle) {
  const double turned = std::remainder(angle, 2.0 * M_PI);
  return turned <= -M_PI ? M_PI : turned;
}

FootprintSweep sweepOf(const Footprint& footprint, const OccupancyGrid& map, int occupied_min) {
  return {footprint, map.geometry(), vehicle::mapObstacles(map, {0, occupied_min}, false)};
}

// So short that no cell is skipped.
double longestPiece(const VehicleOptions& o, double resolution) {
  return std::min(0.5 * resolution, o.vehicle_radius);
}

// How far from the vehicle's middle the cells of the map are looked at.
double reachOf(const VehicleOptions& o) {
  return std::max(o.vehicle_radius,
                  Footprint::fromText("footprint", o.footprint).circumscribedRadius()) +
         2.0 * kContactEnds;
}

// Throws InputError where a step would take longer than anybody waits for, its end by a signal included.
void checkCells(const VehicleOptions& o, double resolution) {
  const double motion = std::hypot(o.max_surge_speed, o.max_sway_speed) * o.time_step;
  const double looks = std::ceil(motion / longestPiece(o, resolution)) + kContactHalvings + 2.0;
  const double side = 2.0 * reachOf(o) / resolution + 1.0;
  if (looks * side * side <= kMostCells) return;
  throw InputError("cells of " + decimalText(resolution) + " m are too small for vehicle_radius " +
                   decimalText(o.vehicle_radius) + " m and time_step " + decimalText(o.time_step) +
                   " s: a step would look at more than " + decimalText(kMostCells) + " cells");
}

}  // namespace

Eigen::Isometry3d mapFromBase(const VehicleState& state) {
  Eigen::Isometry3d pose =
      Eigen::Translation3d(state.position) * Eigen::AngleAxisd(state.yaw, Eigen::Vector3d::UnitZ());
  if (state.level()) return pose;  // to the bit what a vehicle without roll and pitch has
  pose.rotate(Eigen::AngleAxisd(state.pitch, Eigen::Vector3d::UnitY()));
  return pose.rotate(Eigen::AngleAxisd(state.roll, Eigen::Vector3d::UnitX()));
}

BodyTwist bodyTwist(const VehicleState& state) {
  const BodyVelocity& v = state.velocity;
  BodyTwist twist{{v.surge, v.sway, v.heave}, {state.roll_rate, state.pitch_rate, v.yaw_rate}};
  if (state.level()) return twist;
  const Eigen::Matrix3d from_pitched =
      Eigen::AngleAxisd(-state.roll, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Eigen::Matrix3d from_level =
      from_pitched * Eigen::AngleAxisd(-state.pitch, Eigen::Vector3d::UnitY());
  twist.linear = from_level * twist.linear;
  twist.angular = from_level * Eigen::Vector3d(0.0, 0.0, v.yaw_rate) +
                  from_pitched * Eigen::Vector3d(0.0, state.pitch_rate, 0.0) +
                  Eigen::Vector3d(state.roll_rate, 0.0, 0.0);
  return twist;
}

Vehicle::Vehicle(const VehicleOptions& options, const VehicleState& initial) {
  setOptions(options);
  reset(initial);
}

void Vehicle::setOptions(const VehicleOptions& options) {
  checkVehicleOptions(options);
  if (map_) checkCells(options, map_->geometry().resolution());
  footprint_ =
      std::make_shared<const Footprint>(Footprint::fromText("footprint", options.footprint));
  options_ = options;
}

void Vehicle::setMap(std::shared_ptr<const OccupancyGrid> map) {
  if (map) checkCells(options_, map->geometry().resolution());
  map_ = std::move(map);
  if (isClear()) in_contact_ = false;
}

void Vehicle::setWorld(std::shared_ptr<const World> world) {
  world_ = std::move(world);
  if (isClear()) in_contact_ = false;
}

void Vehicle::setBodies(std::shared_ptr<const MovingBodies> bodies) {
  bodies_ = std::move(bodies);
  if (isClear()) in_contact_ = false;
}

void Vehicle::command(const BodyVelocity& velocity) {
  if (!velocity.isFinite())
    throw InputError("a velocity command must be four finite numbers, got surge " +
                     std::to_string(velocity.surge) + ", sway " + std::to_string(velocity.sway) +
                     ", heave " + std::to_string(velocity.heave) + ", yaw rate " +
                     std::to_string(velocity.yaw_rate));
  waiting_.push_back({time_ns_ + nanoseconds(options_.dead_time), velocity});
  beginCommands();
}

void Vehicle::beginCommands() {
  while (!waiting_.empty() && waiting_.front().begins_ns <= time_ns_) {
    commanded_ = waiting_.front().velocity;
    command_ends_ns_ = waiting_.front().begins_ns + nanoseconds(options_.cmd_vel_timeout);
    waiting_.pop_front();
  }
}

bool Vehicle::commandRunsOut() const {
  return !commanded_.isZero() && time_ns_ < command_ends_ns_ &&
         time_ns_ + nanoseconds(options_.time_step) >= command_ends_ns_;
}

void Vehicle::reset(const VehicleState& state) {
  if (!state.position.allFinite() || !std::isfinite(state.yaw) || !state.velocity.isFinite())
    throw InputError("a vehicle's state must be finite, got position " +
                     std::to_string(state.position.x()) + ", " +
                     std::to_string(state.position.y()) + ", " +
                     std::to_string(state.position.z()) + " and yaw " + std::to_string(state.yaw));
  state_ = state;
  state_.yaw = normalized(state.yaw);
  rock();
  commanded_ = {};
  waiting_.clear();
  contacts_ = 0;
  in_contact_ = false;
  touched_.clear();
}

void Vehicle::step() {
  beginCommands();
  const BodyVelocity before = state_.velocity;
  changeVelocity(options_.time_step);
  move(options_.time_step, before);
  time_ns_ += nanoseconds(options_.time_step);
  rock();
  touchBodies();
}

void Vehicle::rock() {
  const auto swing = [this](double amplitude, double period, double& angle, double& rate) {
    angle = rate = 0.0;
    if (amplitude == 0.0) return;  // no zeros with a sign
    const double frequency = 2.0 * M_PI / period;
    angle = amplitude * std::sin(frequency * time());
    rate = amplitude * frequency * std::cos(frequency * time());
  };
  swing(options_.roll_amplitude, options_.roll_period, state_.roll, state_.roll_rate);
  swing(options_.pitch_amplitude, options_.pitch_period, state_.pitch, state_.pitch_rate);
}

BodyVelocity Vehicle::setPoint() const {
  if (time_ns_ >= command_ends_ns_) return {};
  const auto held = [](double value, double limit) { return std::clamp(value, -limit, limit); };
  return {held(commanded_.surge, options_.max_surge_speed),
          held(commanded_.sway, options_.max_sway_speed),
          held(commanded_.heave, options_.max_heave_speed),
          held(commanded_.yaw_rate, options_.max_yaw_rate)};
}

void Vehicle::changeVelocity(double seconds) {
  const BodyVelocity target = setPoint();
  const double linear = options_.max_acceleration * seconds;
  const double share =
      options_.response_time > 0.0 ? -std::expm1(-seconds / options_.response_time) : 1.0;
  BodyVelocity& v = state_.velocity;
  v.surge = towards(v.surge, target.surge, share, linear);
  v.sway = towards(v.sway, target.sway, share, linear);
  v.heave = towards(v.heave, target.heave, share, linear);
  v.yaw_rate = towards(v.yaw_rate, target.yaw_rate, share, options_.max_yaw_acceleration * seconds);
  if (options_.least_turning_radius <= 0.0) return;
  const double fastest = std::abs(v.surge) / options_.least_turning_radius;
  v.yaw_rate = std::clamp(v.yaw_rate, -fastest, fastest);
}

// Trapezoids in the body frame, turned by the yaw at half of the step.
void Vehicle::move(double seconds, const BodyVelocity& before) {
  const BodyVelocity& v = state_.velocity;
  const double turn = 0.5 * (before.yaw_rate + v.yaw_rate) * seconds;
  const double surge = 0.5 * (before.surge + v.surge) * seconds;
  const double sway = 0.5 * (before.sway + v.sway) * seconds;
  const double yaw = state_.yaw + 0.5 * turn;
  const Eigen::Vector2d motion(std::cos(yaw) * surge - std::sin(yaw) * sway,
                               std::sin(yaw) * surge + std::cos(yaw) * sway);
  const Eigen::Vector3d from = state_.position;
  const bool outlined = map_ && !footprint_->empty();
  const bool free_in_plane = outlined ? moveFootprint(motion, turn) : moveInPlane(motion);
  if (!free_in_plane) state_.velocity.surge = state_.velocity.sway = 0.0;
  if (!free_in_plane && outlined) state_.velocity.yaw_rate = 0.0;
  state_.position.z() += 0.5 * (before.heave + state_.velocity.heave) * seconds;
  const bool free_in_world = moveInWorld(from);
  if (!free_in_world) state_.velocity.surge = state_.velocity.sway = state_.velocity.heave = 0.0;
  if (in_contact_ && free_in_plane && free_in_world && isClear()) in_contact_ = false;
  if (!outlined) state_.yaw = normalized(state_.yaw + turn);
}

// Drives and turns up to the first contact. One that stands in an obstacle may leave it.
bool Vehicle::moveFootprint(const Eigen::Vector2d& motion, double turn) {
  const FootprintSweep sweep = sweepOf(*footprint_, *map_, options_.occupied_min);
  const Eigen::Vector2d from = state_.position.head<2>();
  const auto blocked = [&](double share) {
    const Motion part{from, from + share * motion, state_.yaw, share * turn};
    return sweep.first(part, base::StopToken()).has_value();
  };
  double free = 1.0;
  if (!sweep.standing(from, state_.yaw) && blocked(1.0)) {
    free = 0.0;
    for (double closed = 1.0; closed - free > kFootprintShare;)
      (blocked(0.5 * (free + closed)) ? closed : free) = 0.5 * (free + closed);
    startContact("projected_map");
  }
  state_.position.head<2>() = from + free * motion;
  state_.yaw = normalized(state_.yaw + free * turn);
  return free == 1.0;
}

// Moves along `motion` up to the first contact, in pieces so short that no cell is skipped. Returns
// whether all of it was driven.
bool Vehicle::moveInPlane(const Eigen::Vector2d& motion) {
  if (!map_) {
    state_.position.head<2>() += motion;
    return true;
  }
  const double longest = longestPiece(options_, map_->geometry().resolution());
  const int pieces = std::max(1, static_cast<int>(std::ceil(motion.norm() / longest)));
  const Eigen::Vector2d from = state_.position.head<2>();
  double distance = clearance(from);
  const auto blocked = [&](double share) {
    const double there = clearance(from + share * motion);
    return there < options_.vehicle_radius - kTouch && there < distance;
  };
  for (int i = 1; i <= pieces; ++i) {
    double free = static_cast<double>(i - 1) / pieces;
    double closed = static_cast<double>(i) / pieces;
    if (!blocked(closed)) {
      state_.position.head<2>() = from + closed * motion;
      distance = clearance(state_.position.head<2>());
      continue;
    }
    for (int halving = 0; halving < kContactHalvings; ++halving) {
      const double middle = 0.5 * (free + closed);
      (blocked(middle) ? closed : free) = middle;
    }
    state_.position.head<2>() = from + free * motion;
    startContact("projected_map");
    return false;
  }
  return true;
}

// Undoes what the step that began at `from` did after the first contact. Returns whether there was
// none.
bool Vehicle::moveInWorld(const Eigen::Vector3d& from) {
  if (!world_) return true;
  const SweptSphere swept = sweptSphere(*world_, options_.vehicle_radius, from, state_.position);
  state_.position = swept.end;
  if (!swept.touched) return true;
  startContact(std::string(swept.touched->name));
  return false;
}

void Vehicle::touchBodies() {
  if (!bodies_) return;
  const auto touched = bodies_->at(time()).nearest(state_.position, options_.vehicle_radius);
  if (touched) startContact(std::string(touched->name));
}

void Vehicle::startContact(const std::string& name) {
  if (!in_contact_) ++contacts_;
  in_contact_ = true;
  touched_ = name;
}

bool Vehicle::isClear() const {
  const double reach = options_.vehicle_radius + kContactEnds;
  if (map_ && !footprint_->empty() && touchesWith(kContactEnds)) return false;
  return (!map_ || !footprint_->empty() || clearance(state_.position.head<2>()) > reach) &&
         (!world_ || !world_->nearest(state_.position, reach)) &&
         (!bodies_ || !bodies_->at(time()).nearest(state_.position, reach));
}

bool Vehicle::touchesWith(double margin) const {
  const Footprint grown = vehicle::Outline(*footprint_).grown(margin).polygon();
  return sweepOf(grown, *map_, options_.occupied_min)
      .standing(state_.position.head<2>(), state_.yaw)
      .has_value();
}

double Vehicle::clearance(const Eigen::Vector2d& position) const {
  return obstacleDistance(*map_, options_.occupied_min, position, reachOf(options_));
}

}  // namespace grid_path_planner::simulation
