// What local_planner commands: cmd_vel and setpoint_velocity, from a thread of their own.
//
//   FlightCommander commander(nh, LocalPlannerOptions(), [](unsigned handovers) {});
//   commander.begin(0);                                   // with every route
//   commander.command({{0.5, 0.0, 0.0, 0.0}, {0.4, 0.0, 0.0, 0.0}, 0.0, ros::Time::now(), 0.2});   // with every answer
//
// Clouds, plans, logs, views and services have other threads, however long they take. A command is sent as soon
// as it is handed over, and again where no other has come for a period of control_rate. Guaranteed: where it has been held
// for longer than frame_period (one and a half periods, if those are longer), or what it rests on has grown too old by ROS
// time, the vehicle is braked to a stand by max_acceleration on each axis, without a turn, from the velocity that it had,
// as it may have changed since, or from the command where that is less. That is the braking for which the pilot has seen
// to room (avoidance/steering/braking.h); a plan that comes meanwhile finds the vehicle a little slower. Zeros take
// the command's place where ROS time went back and where the flight is held, and last until the next. A command with a
// number that is none is a zero. What is sent, and what holds the vehicle whatever is flown: command_gate.h.
#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "grid_path_planner/base/body_velocity.h"
#include "ros/avoidance/flight_hold.h"
#include "ros/avoidance/local_planner_options.h"
#include "ros/gate/command_gate.h"
#include "ros/guard/outgoing/direct_publisher.h"

namespace grid_path_planner::nodes {

class FlightCommander {
 public:
  struct Command {
    base::BodyVelocity velocity = {};
    base::BodyVelocity measured = {};  // that the decision rests on
    double yaw = 0.0;                  // rad, of the vehicle in map_frame
    ros::Time time = {};               // of the decision
    double good_for = 0.0;             // s of ROS time, until the clouds or the pose are too old
    bool is_last = false;              // the flight has ended: nothing follows
  };

  // `on_handover` is called in the thread, as CommandGate says.
  FlightCommander(const ros::NodeHandle& nh, const LocalPlannerOptions& options,
                  std::function<void(unsigned handovers)> on_handover);
  // A zero, as finish() says.
  ~FlightCommander();

  // Thread-safe, all of these.
  // A flight begins that was given when on_handover had said `handovers`, 0 before it had. Returns whether nobody has
  // taken the vehicle, or let go of it, since.
  bool begin(unsigned handovers);
  // Whether a joystick has paused the flight since the last call. With every plan.
  bool notice(bool flies) { return hold_.notice(flies, gate_.isManual()); }
  FlightHold::Answer pause(bool flies) { return hold_.pause(flies); }
  FlightHold::Answer resume(bool flies) { return hold_.resume(flies, gate_.isManual()); }
  bool endPause() { return hold_.endPause(); }
  // Why nothing is flown now, in a sentence; empty: it may be.
  std::string hold() const;
  void command(const Command& command);
  void setOptions(const LocalPlannerOptions& options);  // precondition: checked
  // A zero ends the flight of a node that ends; no command is sent after this. Waits until it is. To be called
  // before anything that asks the master, which may not answer.
  void finish();

  const CommandGate& gate() const { return gate_; }
  // How many motions were braked for want of a newer command.
  unsigned overdue() const { return overdue_; }
  // Messages on stop and manual_control whose bytes were none of it.
  unsigned refused() const { return refused_; }

 private:
  using Clock = std::chrono::steady_clock;

  CommandGate::Owner owner(std::function<void(unsigned)> on_handover);
  // In the thread:
  void take(const Command& command, Clock::time_point handed_over);
  void use(const LocalPlannerOptions& options);
  void tick();
  void beginToBrake();
  bool isOverdue() const;
  base::BodyVelocity due() const;
  void send(const base::BodyVelocity& velocity);

  FlightHold hold_;
  std::string map_frame_;
  std::atomic<double> master_timeout_{0.0};  // s
  Clock::duration most_held_{}, period_{};
  double max_acceleration_ = 0.0, frame_period_ = 0.0;  // m/s^2, s
  Command command_;
  Clock::time_point handed_over_;
  std::optional<Clock::time_point> brakes_since_;
  bool flies_ = false;
  std::atomic<unsigned> overdue_{0};
  std::atomic<unsigned> refused_{0};

  CommandGate gate_;
  DirectPublisher setpoint_;
};

}  // namespace grid_path_planner::nodes
