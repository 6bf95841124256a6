// An underwater vehicle with four degrees of freedom (surge, sway, heave, yaw) that follows
// velocity commands as fast as its response and accelerations allow, and that obstacles stop: the cells
// of a map, the surfaces of a world, or both. Moving bodies touch it and do not stop it.
//
//   Vehicle vehicle(options, {Eigen::Vector3d(1.0, 2.0, -3.0), 0.0});
//   vehicle.setWorld(world);
//   vehicle.command({0.5, 0.0, 0.0, 0.1});
//   for (int i = 0; i < 100; ++i) vehicle.step();
//   if (vehicle.contacts() > 0) std::cout << "ran into " << vehicle.touched() << "\n";
//
// Guaranteed: the same calls give the same states, bit for bit; no clock is read, time is the sum
// of the steps. The vehicle stops by itself cmd_vel_timeout after the last command. Its disc does
// not enter an occupied cell: the motion in the plane ends at the first contact; with a footprint, which is the outline then,
// so do turns. Its sphere does not
// enter a surface of the world: all motion but the turn ends at the first contact. A vehicle that
// was put into an obstacle may leave it. Not modelled: water,
// currents; the map is flat, so its obstacles stand at every depth. Outside map and world there are no
// obstacles. Roll and pitch are those of a vehicle that rocks: sines of the time alone, which turn what
// its sensors see and change nothing of where it goes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "grid_path_planner/base/body_velocity.h"
#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/simulation/moving_bodies.h"
#include "grid_path_planner/simulation/vehicle_options.h"
#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::vehicle {
class Footprint;
}  // namespace grid_path_planner::vehicle

namespace grid_path_planner::simulation {

struct VehicleState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, map frame
  double yaw = 0.0;                                    // rad, in (-pi, pi]
  base::BodyVelocity velocity = {};                    // of the heading's frame, which is level
  double roll = 0.0;                                   // rad, about the vehicle's own x axis
  double pitch = 0.0;                                  // rad, before the roll; positive: bow down
  double roll_rate = 0.0;                              // rad/s, derivatives of the two angles
  double pitch_rate = 0.0;

  bool level() const { return roll == 0.0 && pitch == 0.0; }
};

// base_link in the map: turned by yaw, then pitch, then roll (REP 103).
Eigen::Isometry3d mapFromBase(const VehicleState& state);

// How base_link moves, along and about its own axes, which the vehicle's tilt turns.
struct BodyTwist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   // m/s
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  // rad/s
};
BodyTwist bodyTwist(const VehicleState& state);

class Vehicle {
 public:
  // Throws InputError for options or a state that checkVehicleOptions or `reset` refuse.
  explicit Vehicle(const VehicleOptions& options = {}, const VehicleState& initial = {});

  // From the next step on. Throws InputError as the constructor does, and as setMap() where the map is too
  // fine for these; then nothing has changed.
  void setOptions(const VehicleOptions& options);
  const VehicleOptions& options() const { return options_; }

  // The obstacles; a null pointer removes them. Contacts counted so far stay. Throws InputError for cells so
  // small that one step would look at more than 10^8 of them; the map before stays.
  void setMap(std::shared_ptr<const grid::OccupancyGrid> map);
  // The same for the solid surfaces of a world.
  void setWorld(std::shared_ptr<const World> world);

  // The same for bodies, which move by this vehicle's time().
  void setBodies(std::shared_ptr<const MovingBodies> bodies);

  // The velocity to reach, from now until cmd_vel_timeout later or the next command. Clamped to the
  // vehicle's limits, axis by axis. Throws InputError for numbers that are not finite; the command
  // before stays.
  void command(const base::BodyVelocity& velocity);

  // Whether a command other than to stop holds, and no more after the next step.
  bool commandRunsOut() const;

  // Puts the vehicle somewhere: no command, contacts 0; time goes on, and so do roll and pitch, which
  // are not taken from `state`. Throws InputError for a state that is not finite.
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
  // What it ran into last: the name of a mesh of the world or of a body, or "projected_map" for a cell of the
  // map; "" where it has not run into anything since the construction or `reset`.
  const std::string& touched() const { return touched_; }

 private:
  base::BodyVelocity setPoint() const;
  void changeVelocity(double seconds);
  void move(double seconds, const base::BodyVelocity& before);
  bool moveInPlane(const Eigen::Vector2d& motion);
  bool moveFootprint(const Eigen::Vector2d& motion, double turn);
  void beginCommands();
  bool moveInWorld(const Eigen::Vector3d& from);
  void touchBodies();
  void rock();
  void startContact(const std::string& name);
  bool isClear() const;
  bool touchesWith(double margin) const;
  double clearance(const Eigen::Vector2d& position) const;

  VehicleOptions options_;
  VehicleState state_;
  base::BodyVelocity commanded_;
  std::int64_t command_ends_ns_ = 0;
  struct Waiting {
    std::int64_t begins_ns;
    base::BodyVelocity velocity;
  };
  std::deque<Waiting> waiting_;  // commands in their dead time
  std::int64_t time_ns_ = 0;
  std::shared_ptr<const vehicle::Footprint> footprint_;  // empty: the disc
  std::shared_ptr<const grid::OccupancyGrid> map_;
  std::shared_ptr<const World> world_;
  std::shared_ptr<const MovingBodies> bodies_;
  std::string touched_;
  int contacts_ = 0;
  bool in_contact_ = false;
};

}  // namespace grid_path_planner::simulation
