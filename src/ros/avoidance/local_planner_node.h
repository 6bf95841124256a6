// The node `local_planner`: flies to goals through space of which there is no map.
//
//   subscribes  points          sensor_msgs/PointCloud2
//               camera_info     sensor_msgs/CameraInfo of the same frame and size; without it only
//                               measured rays tell what is free. With ~cloud_topics other clouds
//                               instead, each with the camera_info beside it
//               odom            nav_msgs/Odometry; the velocity. Without it that commanded last counts
//               goal            geometry_msgs/PoseStamped
//               path            nav_msgs/Path; flown along. An empty one stops the vehicle
//               stop            std_msgs/Bool; zeros while it is true
//               manual_control  std_msgs/Bool; a joystick commands: the flight is paused until ~resume
//               tf              the poses of the vehicle and of the clouds' sensor
//   publishes   cmd_vel            geometry_msgs/Twist in base_frame
//               setpoint_velocity  geometry_msgs/TwistStamped in map_frame
//               setpoint_trajectory  trajectory_msgs/MultiDOFJointTrajectory in map_frame
//               drive_cancelled    std_msgs/Empty; by ~cancel
//               local_path         nav_msgs/Path, latched
//               avoidance_status   grid_path_planner/AvoidanceStatus, latched
//               obstacle_distance  sensor_msgs/LaserScan
//               remembered_points  sensor_msgs/PointCloud2
//               histogram_image    sensor_msgs/Image
//               avoidance_markers  visualization_msgs/MarkerArray
//               /diagnostics
//   services    ~pause, ~resume, ~cancel, ~explain   std_srvs/Trigger
//   action      navigate_path   grid_path_planner/NavigatePathAction, instead of the node of that name
//
// Guaranteed: without a route nothing is published on cmd_vel but zeros while `stop` is true, so that others
// may command the vehicle; a zero at its end, and on every orderly shutdown. A cloud or a pose that is older
// than cloud_timeout or tf_timeout stops the vehicle, and so do ROS time that stands still for 0.5 s and a
// master that is silent for master_timeout. While a joystick commands nothing is published. A goal or path
// that cannot be flown is refused with an error, one from before the node's start with a warning, and the
// present flight goes on; goals without a stamp are new. ROS time that goes back cancels the flight and
// forgets what was seen. The node does not start where another publishes cmd_vel (but a joystick, and with
// ~share_cmd_vel) or offers the action; one that comes later is told in /diagnostics.
//
// The queue's thread unpacks clouds, plans, publishes what is seen and writes the logs; another commands
// (flight_commander.h) and stops the vehicle while the first is late, however long that takes. Files are read, maps
// made and planned on in further ones. Not guaranteed: a zero after SIGKILL: the vehicle
// itself must stop when commands cease.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/avoidance/pilot.h"
#include "ros/avoidance/cloud_frames.h"
#include "ros/avoidance/flight_action.h"
#include "ros/avoidance/flight_commander.h"
#include "ros/avoidance/flight_hold.h"
#include "ros/avoidance/flight_publisher.h"
#include "ros/avoidance/flight_views.h"
#include "ros/avoidance/local_planner_options.h"
#include "ros/avoidance/logged_pilot.h"
#include "ros/avoidance/map_planner.h"
#include "ros/guard/master/command_claim.h"
#include "ros/guard/master/other_commanders.h"
#include "ros/guard/node_files.h"
#include "ros/guard/node_time.h"
#include "ros/input/finished_goals.h"
#include "ros/input/frame_lookup.h"

namespace grid_path_planner {
class LocalPlannerConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class LocalPlannerNode {
 public:
  // A waypoint file that no argument names lies below the folder to load from. Throws InputError for
  // parameters and files that cannot be used, and another node that commands. All callbacks are served
  // by the queue of `nh`, which must be one thread's.
  LocalPlannerNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const NodeFiles& files = {});
  // Zeroes cmd_vel.
  ~LocalPlannerNode();

  // Zeroes cmd_vel, and nothing is commanded any more. Thread-safe.
  void stop() { commander_.finish(); }

 private:
  void subscribe();
  void startLog(const NodeFiles& files);
  void flyFile(const NodeFiles& files);
  FlightAction::Callbacks actionCallbacks();
  void noteHandover(unsigned handovers);
  void endGoalsUntilNow();
  FlightHold::Answer cancelByHand();
  void offerServices(ros::NodeHandle& private_nh);
  void use(LocalPlannerOptions options);
  void startTimer();
  void startDiagnostics();
  void onGoal(const geometry_msgs::PoseStamped& goal);
  void onPath(const nav_msgs::Path& path);
  bool hasTime();
  void timeWentBack(double seconds);
  bool isOfAnotherTime(const char* what, const ros::Time& stamp);
  Placing placingInMap() const {
    return {options_.map_frame, options_.tf_timeout, Moving::WITH_VEHICLE, options_.base_frame,
            options_.zero_heading};
  }
  // `handovers`: handovers_ when it was given.
  void fly(const path::Path& path, bool along, unsigned handovers);
  void control();
  void tick(const ros::Time& now);
  base::BodyVelocity velocityAt(const ros::Time& now) const;
  avoidance::PilotInput input(const ros::Time& now);
  void takeFrames(avoidance::PilotInput& input);
  bool hasFlight() const;
  void publish(const ros::Time& now);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle nh_;
  LocalPlannerOptions options_;
  const CommandClaim commands_;
  OtherCommanders others_{commands_};
  FrameTransforms transforms_;
  MapPlanner map_;
  LoggedPilot pilot_;
  avoidance::PilotAnswer answer_;
  CloudFrames clouds_;
  std::vector<avoidance::Frame> frames_;  // of this update
  FlightPublisher publisher_;
  FlightViews views_;
  std::optional<nav_msgs::Odometry> odometry_;
  FlightCommander commander_;
  bool had_time_ = false;
  avoidance::VehiclePose at_;
  double good_for_ = 0.0;         // s from the newest plan, until clouds or pose are too old
  FinishedGoals finished_goals_;  // of the topic `path`
  unsigned handovers_ = 0;        // of the gate, as this queue has heard
  bool flies_ = false;            // there is a route, and cmd_vel is published

  ros::Publisher cancelled_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  std::unique_ptr<FlightAction> action_;
  diagnostic_updater::Updater diagnostics_;
  ros::SteadyTimer control_timer_, diagnostics_timer_;
  std::unique_ptr<Reconfigurable<LocalPlannerConfig, LocalPlannerOptions>> reconfigurable_;
  std::shared_ptr<void> on_jump_back_;
};

}  // namespace grid_path_planner::nodes
