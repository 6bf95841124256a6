// The control loop of navigate_path: a thread of its own that follows the path and publishes
// cmd_vel, at a rate by the wall clock.
//
//   unsigned handovers = 0;
//   DriveLoop loop(nh, options, transforms, {[&] { queue(&takeReports); }, [&](unsigned n) { handovers = n; }});
//   loop.start(path, Join::NEAREST, handovers);  // throws InputError
//   for (const DriveReport& report : loop.takeReports()) use(report.note);
//
// The follower belongs to this thread alone: others hand it work over a callback queue, and it serves
// the topics that must be obeyed whatever else the node does. Guaranteed: the thread reads no file,
// logs nothing, publishes nothing but cmd_vel, and takes no lock that code holds which does. A
// non-zero velocity is followed by a zero within a tick when the drive ends, is paused or blocked,
// and by the wall clock when ROS time stands still. While `stop` is true there are zeros only, and
// while a joystick commands (`manual_control`) there is nothing at all: the drive is paused, and
// resumed by hand. A velocity is written to its connections by this thread itself. How it is scheduled:
// control_thread.h.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <std_msgs/Bool.h>
#include <std_msgs/String.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/following/path_follower.h"
#include "ros/driving/hold_reasons.h"
#include "ros/driving/motion_gate.h"
#include "ros/guard/outgoing/direct_publisher.h"
#include "ros/guard/scheduling/control_thread.h"
#include "ros/input/frame_lookup.h"
#include "ros/input/manual_control.h"
#include "vehicle/footprint.h"

namespace grid_path_planner::nodes {

// How a drive stands.
struct DriveStanding {
  following::FollowState state;
  following::DriveStatus status;
  std::string message;
  int waypoint = 0;
  std::size_t waypoints = 0;
  double distance_remaining = 0.0;  // m
  double time_remaining = 0.0;      // s
  bool obstructed = false;          // blocked by the path ahead
  bool holding_ended = false;       // it has arrived, is off, and is not brought back
  std::vector<int> missed;
  double position_error = 0.0;  // m
  double yaw_error = 0.0;       // rad
};

// What happened: an event of the follower, another waypoint, or what is said in the note.
struct DriveReport {
  std::optional<following::FollowEvent> event;
  unsigned drive = 0;      // which one, as start() counts them
  DriveStanding standing;  // of an event that ends it
  std::optional<geometry_msgs::PoseStamped> waypoint;
  std::string note;
};

class DriveLoop {
 public:
  // Both are called in the loop's thread.
  struct Callbacks {
    std::function<void()> on_report;  // there is the first report since takeReports()
    // A joystick has taken over, or let go of, a vehicle that nothing drives; `handovers`: how often that was so far.
    std::function<void(unsigned handovers)> on_handover;
  };

  DriveLoop(const ros::NodeHandle& nh, const NavigatePathOptions& options,
            FrameTransforms& transforms, Callbacks callbacks);
  // Cancels the drive and publishes a zero.
  ~DriveLoop();

  // These are carried out in the loop's thread, with a tick after them, and waited for.
  // Returns the drive's number. Throws InputError. A drive that was given when on_handover had said `handovers`, 0
  // before it had, ends at once where there was another since.
  unsigned start(const path::Path& path, following::Join join, unsigned handovers);
  following::PathFollower::Answer pause();
  following::PathFollower::Answer resume();
  following::PathFollower::Answer cancel(const std::string& reason);
  void abandon(const std::string& reason);  // PathFollower::abandon
  // Cancels the drive of a node that ends, begins no other, and waits until the last command is sent. To be
  // called before anything that asks the master, which may not answer.
  void finish();
  void setOptions(const NavigatePathOptions& options);  // precondition: checked
  DriveStanding standing();

  // Handed over, not waited for.
  void setMap(const MapLiveness& life);
  void setSpeedLimits(const SpeedLimits& limits);

  std::vector<DriveReport> takeReports();

  // How the thread is scheduled, in words.
  std::string scheduling() const { return thread_.scheduling(); }

  // Resolved names.
  std::string velocityTopic() const { return velocity_publisher_.topic(); }
  std::string manualTopic() const { return manual_subscriber_.getTopic(); }
  std::size_t numberOfListeners() const { return velocity_publisher_.numberOfListeners(); }

 private:
  using Clock = std::chrono::steady_clock;

  // In the loop's thread:
  void tick();
  void giveUpTick();
  void timeWentBack(double seconds);
  void follow(const ros::Time& now);
  void findVehicle(following::FollowInput& input) const;
  void checkMotions(following::FollowInput& input) const;
  std::string whyNotFree(const std::vector<Eigen::Vector3d>& ahead) const;
  std::vector<Eigen::Vector3d> inFrame(const std::string& frame,
                                       const std::vector<Eigen::Vector3d>& points) const;
  double allowedSpeed(const std::vector<Eigen::Vector3d>& ahead) const;
  void onManual(const std_msgs::Bool& message);
  void onStop(const std_msgs::Bool& message);
  void onLocalization(const std_msgs::String& message);
  void noteRefused();
  void noteHandover();
  void yieldToJoystick();
  void publish(const base::BodyVelocity& velocity);
  void report(const ros::Time& now);
  void hand(std::vector<DriveReport> reports);
  DriveStanding standingNow() const;

  NavigatePathOptions options_;
  vehicle::Footprint footprint_;  // of the options
  FrameTransforms& transforms_;
  const Callbacks callbacks_;
  following::PathFollower follower_;
  MotionGate gate_;
  HoldReasons holds_;
  unsigned drive_ = 0;  // started so far
  unsigned handovers_ = 0;
  ManualControl joystick_;
  std::optional<Clock::time_point> refused_;  // when a message was, and that was told
  bool finished_ = false;                     // the node ends
  bool silent_ = true;  // nothing, or a zero, was sent last and there is no drive
  int reported_waypoint_ = -1;

  std::mutex reports_mutex_;
  std::vector<DriveReport> reports_;
  bool reports_told_ = false;  // since takeReports()

  DirectPublisher velocity_publisher_;
  ControlThread thread_{[this] { tick(); }, [this] { giveUpTick(); },
                        [this](double seconds) { timeWentBack(seconds); }};
  ros::Subscriber manual_subscriber_;
  ros::Subscriber stop_subscriber_;
  ros::Subscriber localization_subscriber_;
};

}  // namespace grid_path_planner::nodes
