// The control loop of navigate_path: a thread of its own that follows the path and publishes
// cmd_vel, at a rate by the wall clock.
//
//   unsigned handovers = 0;
//   DriveLoop loop(nh, options, transforms, {[&] { queue(&takeReports); }, [&](unsigned n) { handovers = n; }});
//   loop.start(path, Join::NEAREST, handovers);  // throws InputError
//   for (const DriveReport& report : loop.takeReports()) use(report.note);
//
// The follower belongs to this thread alone: others hand it work over a callback queue. What is sent, and what holds the
// vehicle whatever is driven: command_gate.h. A non-zero velocity is followed by a zero within a tick when the drive
// ends, is paused or blocked, and by the wall clock when ROS time stands still. While a joystick commands the drive is
// paused, and it is resumed by hand.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
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
#include "ros/gate/command_gate.h"
#include "ros/input/frame_lookup.h"
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

  const CommandGate& gate() const { return gate_; }

 private:
  using Clock = std::chrono::steady_clock;

  // In the loop's thread:
  CommandGate::Owner owner();
  void tick();
  void timeWentBack(double seconds);
  void follow(const ros::Time& now);
  std::string whyHeld() const;
  void findVehicle(following::FollowInput& input) const;
  void checkMotions(following::FollowInput& input) const;
  std::string whyNotFree(const std::vector<Eigen::Vector3d>& ahead) const;
  std::vector<Eigen::Vector3d> inFrame(const std::string& frame,
                                       const std::vector<Eigen::Vector3d>& points) const;
  double allowedSpeed(const std::vector<Eigen::Vector3d>& ahead) const;
  void onLocalization(const std_msgs::String& message);
  void noteRefused();
  void yieldToJoystick();
  bool isDriven() const;
  void send(const base::BodyVelocity& velocity);
  void report(const ros::Time& now);
  void hand(std::vector<DriveReport> reports);
  DriveStanding standingNow() const;

  NavigatePathOptions options_;
  vehicle::Footprint footprint_;  // of the options
  FrameTransforms& transforms_;
  const Callbacks callbacks_;
  following::PathFollower follower_;
  MotionGate motions_;
  HoldReasons holds_;
  unsigned drive_ = 0;                        // started so far
  std::optional<Clock::time_point> refused_;  // when a message was, and that was told
  int reported_waypoint_ = -1;

  std::mutex reports_mutex_;
  std::vector<DriveReport> reports_;
  bool reports_told_ = false;  // since takeReports()

  CommandGate gate_;
  ros::Subscriber localization_subscriber_;
};

}  // namespace grid_path_planner::nodes
