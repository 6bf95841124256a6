// An underwater vehicle with four degrees of freedom (surge, sway, heave, yaw) that follows
// velocity commands as fast as its accelerations allow, and that obstacles of a map hold up.
//
//   Vehicle vehicle(options, {Eigen::Vector3d(1.0, 2.0, -3.0), 0.0});
//   vehicle.setMap(map);
//   vehicle.command({0.5, 0.0, 0.0, 0.1});
//   for (int i = 0; i < 100; ++i) vehicle.step();
//
// Guaranteed: the same calls give the same states, bit for bit; no clock is read, time is the sum
// of the steps. The vehicle stops by itself cmd_vel_timeout after the last command. Its disc does
// not enter an occupied cell: the motion in the plane ends at the first touch. Where it has been
// put into one it may leave. Not modelled: water, currents, roll and pitch; the map is flat, so
// obstacles stand at every depth. Outside the map there are no obstacles.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "grid_path_planner/base/body_velocity.h"
#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/simulation/vehicle_options.h"

namespace grid_path_planner {

struct VehicleState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, map frame
  double yaw = 0.0;                                    // rad, in (-pi, pi]
  BodyVelocity velocity = {};
};

class Vehicle {
 public:
  // Throws InputError for options or a state that checkVehicleOptions or `reset` refuse.
  explicit Vehicle(const VehicleOptions& options = {}, const VehicleState& initial = {});

  // From the next step on. Throws InputError as the constructor does, then nothing has changed.
  void setOptions(const VehicleOptions& options);
  const VehicleOptions& options() const { return options_; }

  // The obstacles; a null pointer takes them away. Contacts counted so far stay.
  void setMap(std::shared_ptr<const OccupancyGrid> map);

  // The velocity to reach, from now until cmd_vel_timeout later or the next command. Faster than
  // the vehicle's limits: held to them, axis by axis. Throws InputError for numbers that are not
  // finite; the command before stays.
  void command(const BodyVelocity& velocity);

  // Puts the vehicle somewhere: no command, contacts 0; time goes on. Throws InputError for a state
  // that is not finite.
  void reset(const VehicleState& state);

  // One time_step.
  void step();

  const VehicleState& state() const { return state_; }
  // Sum of the steps since construction, in nanoseconds: exact over any length of time.
  std::int64_t timeNs() const { return time_ns_; }
  double time() const { return static_cast<double>(time_ns_) * 1e-9; }

  // How often the vehicle has run into an obstacle. Staying there, pushing on, is the same contact;
  // it ends when the vehicle is more than a millimetre clear.
  int contacts() const { return contacts_; }
  bool inContact() const { return in_contact_; }

 private:
  BodyVelocity setPoint() const;
  void changeVelocity(double seconds);
  void move(double seconds, const BodyVelocity& before);
  bool moveInPlane(const Eigen::Vector2d& way);
  double clearance(const Eigen::Vector2d& position) const;

  VehicleOptions options_;
  VehicleState state_;
  BodyVelocity commanded_;
  std::int64_t command_ends_ns_ = 0;
  std::int64_t time_ns_ = 0;
  std::shared_ptr<const OccupancyGrid> map_;
  int contacts_ = 0;
  bool in_contact_ = false;
};

}  // namespace grid_path_planner
