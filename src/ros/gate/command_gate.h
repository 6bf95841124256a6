// What goes out to a vehicle: the thread that commands it, its velocity, and who or what keeps it standing.
//
//   std::unique_ptr<CommandGate> gate;
//   CommandGate::Owner owner;
//   owner.tick = [&] { gate->send(velocity, drives); };
//   owner.drives = [&] { return drives; };
//   gate = std::make_unique<CommandGate>(nh, owner);
//   gate->start({50.0, 1});                          // Hz, real-time priority
//   gate->finish();                                  // a zero, and nothing after it
//
// It serves `stop` and, where a joystick of another node is heeded, `manual_control`. Guaranteed: while `stop` is true
// there are zeros only, and while a joystick commands there is nothing at all; what was driven is followed by a zero; after
// finish() nothing is sent. A velocity is written to its connections by this thread itself, which reads no file, logs
// nothing and takes no lock that code holds which does. send() is for that thread; the questions are for any.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <ros/time.h>
#include <std_msgs/Bool.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "grid_path_planner/base/body_velocity.h"
#include "ros/gate/manual_control.h"
#include "ros/guard/master/master_watch.h"
#include "ros/guard/outgoing/direct_publisher.h"
#include "ros/guard/scheduling/control_thread.h"

namespace grid_path_planner::nodes {

class CommandGate {
 public:
  // What it is asked to do, in its thread.
  struct Owner {
    std::function<void()> tick;  // calls send()
    // In a catch block, in place of a tick that threw; a zero was sent.
    std::function<void()> give_up = [] {};
    std::function<void(double seconds)> time_went_back = [](double) {};
    std::function<bool()> drives;  // whether something is driven, which a joystick pauses
    // A joystick has taken over, or let go of, a vehicle that nothing drives; `handovers`: how often that was so far.
    std::function<void(unsigned handovers)> on_handover = [](unsigned) {};
    std::function<void(bool commands)> on_manual = [](bool) {
    };                                         // before that, and where something is driven too
    std::function<void()> on_refused = [] {};  // a message whose bytes are none of its topic's
  };
  enum class Joystick { HEEDED, OWN };  // of another node: manual_control; the owner's own

  struct Schedule {
    double rate = 50.0;  // Hz, by the wall clock
    int priority = 0;    // real-time, if it is granted; 0: none
  };

  // Advertises cmd_vel.
  CommandGate(const ros::NodeHandle& nh, Owner owner, Joystick joystick = Joystick::HEEDED);
  // Its owner has called finish(), whose members it uses.
  ~CommandGate();

  // Listens and ticks from now on. To be called once.
  void start(const Schedule& schedule);
  void setSchedule(const Schedule& schedule);
  // A zero goes out where the vehicle may move; `last` ends what is driven, and sends nothing but zeros; nothing is sent
  // after that. Waits until it is. To be called before anything that asks the master, which may not answer.
  void finish(const std::function<void()>& last = [] {});
  ControlThread& thread() { return thread_; }
  // Subscriptions by it are served by the thread.
  ros::NodeHandle& handle() { return nh_; }

  // In the thread. A zero takes its place while `stop` is true; nothing is sent while a joystick commands, and no zero
  // again where nothing is `driven`. Returns what was sent.
  std::optional<base::BodyVelocity> send(const base::BodyVelocity& velocity, bool driven);
  // In the thread: whether the node ends.
  bool finished() const { return finished_; }

  bool stopped() const;
  bool isManual() const;
  unsigned handovers() const;
  // What was sent last; a zero while a joystick commands.
  base::BodyVelocity sent() const;
  // Why the vehicle stands whatever is driven: `stop`, a clock that stands still, a master that is gone.
  std::optional<std::string> problem(double master_timeout) const;
  double masterSilence() const { return master_->silence(); }  // s

  std::string scheduling() const { return thread_.scheduling(); }  // in words

 private:
  using Clock = std::chrono::steady_clock;
  using Lock = std::lock_guard<std::mutex>;

  // In the thread:
  void tick();
  void giveUpTick();
  void noteClock();
  void onStop(const std_msgs::Bool& message);
  void onManual(const std_msgs::Bool& message);
  void noteHandover();

  bool clockStands() const;

  const Owner owner_;
  const Joystick whose_;
  const std::shared_ptr<MasterWatch> master_ = MasterWatch::shared();
  bool finished_ = false;  // the node ends
  bool silent_ = true;     // nothing, or a zero, was sent last and nothing is driven

  mutable std::mutex mutex_;  // of the six below
  bool stopped_ = false;      // by the topic
  ManualControl joystick_;
  unsigned handovers_ = 0;
  base::BodyVelocity sent_;
  ros::Time now_;
  Clock::time_point moved_ = Clock::now();  // when ROS time did last

  ros::NodeHandle nh_;  // whose callbacks the thread serves
  DirectPublisher velocity_;
  ControlThread thread_{[this] { tick(); }, [this] { giveUpTick(); },
                        [this](double seconds) { owner_.time_went_back(seconds); }};
  ros::Subscriber stop_subscriber_, manual_subscriber_;
};

}  // namespace grid_path_planner::nodes
