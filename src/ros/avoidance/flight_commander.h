// What local_planner commands: cmd_vel and setpoint_velocity, from a thread of their own.
//
//   FlightHold hold([](unsigned handovers) {});
//   FlightCommander commander(nh, LocalPlannerOptions(), hold);
//   commander.command({{0.5, 0.0, 0.0, 0.0}, {0.4, 0.0, 0.0, 0.0}, 0.0, ros::Time::now(), 0.2});   // with every answer
//
// Clouds, plans, logs, views and services have other threads, however long they take. A command is sent as soon
// as it is handed over, and again where no other has come for a period of control_rate. Guaranteed: where it has been held
// for longer than frame_period (one and a half periods, if those are longer), or what it rests on has grown too old by ROS
// time, the vehicle is braked to a stand by max_acceleration on each axis, without a turn, from the velocity that it had,
// as it may have changed since, or from the command where that is less. That is the braking for which the pilot has seen
// to room (avoidance/steering/braking.h); a plan that comes meanwhile finds the vehicle a little slower. Zeros take
// the command's place where ROS time went back and where the hold says so, and last until the next. While `stop` is
// true there are zeros only, and while a joystick commands nothing. A command with a number that is none is a zero.
// The thread logs nothing, reads and publishes nothing else and takes no lock but for values that are copied; how it is
// scheduled: control_thread.h.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <std_msgs/Bool.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "grid_path_planner/base/body_velocity.h"
#include "ros/avoidance/flight_hold.h"
#include "ros/avoidance/local_planner_options.h"
#include "ros/guard/outgoing/direct_publisher.h"
#include "ros/guard/scheduling/control_thread.h"

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

  // `hold` is told `stop` and `manual_control`; it outlives this.
  FlightCommander(const ros::NodeHandle& nh, const LocalPlannerOptions& options, FlightHold& hold);
  ~FlightCommander() { thread_.stop(); }

  // Thread-safe, all of these.
  void command(const Command& command);
  void setOptions(const LocalPlannerOptions& options);  // precondition: checked
  // A zero ends the flight of a node that ends; no command is sent after this. Waits until it is. To be called
  // before anything that asks the master, which may not answer.
  void finish();

  // How the thread is scheduled, in words.
  std::string scheduling() const { return thread_.scheduling(); }
  // How many motions were braked for want of a newer command.
  unsigned overdue() const { return overdue_; }
  // Messages on stop and manual_control whose bytes were none of it.
  unsigned refused() const { return refused_; }
  // The velocity that was sent last; none while a joystick commands.
  base::BodyVelocity sent() const;

 private:
  using Clock = std::chrono::steady_clock;

  // In the thread:
  void take(const Command& command, Clock::time_point handed_over);
  void use(const LocalPlannerOptions& options);
  void onStop(const std_msgs::Bool& message);
  void onManual(const std_msgs::Bool& message);
  void tick();
  void sendCommand();
  void beginToBrake();
  bool isOverdue() const;
  base::BodyVelocity due() const;
  void send(const base::BodyVelocity& velocity);
  void keep(const base::BodyVelocity& sent);

  FlightHold& hold_;
  std::string map_frame_;
  double master_timeout_ = 0.0;  // s
  Clock::duration most_held_{}, period_{};
  double max_acceleration_ = 0.0, frame_period_ = 0.0;  // m/s^2, s
  Command command_;
  Clock::time_point handed_over_;
  std::optional<Clock::time_point> brakes_since_;
  bool flies_ = false;
  bool finished_ = false;
  std::atomic<unsigned> overdue_{0};
  std::atomic<unsigned> refused_{0};
  mutable std::mutex mutex_;  // of sent_
  base::BodyVelocity sent_;

  DirectPublisher velocity_, setpoint_;
  ControlThread thread_{[this] { tick(); },
                        [this] {
                          if (flies_) send({});
                        },
                        [this](double) { command_.velocity = {}; }};
  ros::Subscriber stop_subscriber_, manual_subscriber_;
};

}  // namespace grid_path_planner::nodes
