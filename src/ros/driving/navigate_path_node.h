// The node `navigate_path`: drives a path, a waypoint file or the goals of an action.
//
//   subscribes  path             nav_msgs/Path; not with ~config_filename. An empty one stops the
//                                vehicle
//               projected_map    nav_msgs/OccupancyGrid; the vehicle stops before occupied cells
//               tf               the vehicle's pose; the vehicle stops while the pose is not known
//   publishes   cmd_vel          geometry_msgs/Twist in base_link
//               current_waypoint geometry_msgs/PoseStamped, latched; the waypoint that is driven to
//               /diagnostics
//   services    ~pause, ~resume, ~cancel   std_srvs/Trigger
//   action      navigate_path    grid_path_planner/NavigatePathAction
//
// Guaranteed: cmd_vel is zeroed on every orderly shutdown, and at once by ~pause and ~cancel; without
// a drive nothing is published, so that others may command the vehicle. A path that cannot be driven
// is refused with an error and the present drive goes on. A goal of the action has priority over
// `path`: paths received meanwhile are ignored with a warning. The rate follows the wall clock, the
// control ROS time, so that both may run at different speeds. ROS time that goes back clears tf and
// cancels the drive. Not guaranteed: a zero after SIGKILL, or as a nodelet when the manager is killed
// or shut down: the vehicle itself must stop when commands cease.
#pragma once

#include <actionlib/server/simple_action_server.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/steady_timer.h>
#include <ros/subscriber.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <string>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/following/path_follower.h"
#include "ros/common/clock.h"
#include "ros/common/frame_transforms.h"
#include "ros/common/map_receiver.h"
#include "ros/common/node_files.h"
#include "ros/driving/navigate_path_options.h"

namespace grid_path_planner {
class NavigatePathConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class NavigatePathNode {
 public:
  // A waypoint file that no argument names lies below the folder to load from. Throws InputError for
  // parameters that cannot be used and a waypoint file that cannot be read.
  // All callbacks are served by the queue of `nh`, which must be one thread's.
  NavigatePathNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const NodeFiles& files = {});
  // Zeroes cmd_vel.
  ~NavigatePathNode();

 private:
  void use(const NavigatePathOptions& options);
  void startTimer();
  void onTimer(const ros::SteadyTimerEvent& event);
  void startDriving(const ros::Time& now);
  void cancelOnTimeJump(const ros::Time& now);
  void control(const ros::Time& now);
  void findVehicle(const ros::Time& now, following::FollowInput& input) const;
  std::string whyOccupied(const std::vector<Eigen::Vector3d>& ahead) const;

  void onPath(const nav_msgs::Path& message);
  void onGoal();
  void onPreempt();
  path::Path readWaypoints(const std::string& filename) const;
  path::Path pathOf(const NavigatePathGoal& goal) const;
  bool answer(const following::PathFollower::Answer& answer, std_srvs::Trigger::Response& response);

  void stop();
  void reportEvents();
  void finishGoal(const std::string& status, const std::string& message);
  void publishVelocity(const base::BodyVelocity& velocity);
  void publishWaypoint(const ros::Time& now);
  void publishFeedback();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle nh_;
  NodeFiles files_;
  NavigatePathOptions options_;
  following::PathFollower follower_;
  FrameTransforms transforms_;
  ClockWatch clock_;
  path::Path file_;  // of config_filename
  ros::Time started_;
  ros::Time now_;
  bool waits_for_clock_ = false;
  bool silent_ = true;  // nothing, or a zero, was sent last and there is no drive
  bool goal_active_ = false;
  int published_waypoint_ = -1;
  MapReceiver map_;

  ros::Publisher velocity_publisher_;
  ros::Publisher waypoint_publisher_;
  ros::Subscriber path_subscriber_;
  std::vector<ros::ServiceServer> services_;
  actionlib::SimpleActionServer<NavigatePathAction> action_;
  diagnostic_updater::Updater diagnostics_;
  ros::SteadyTimer timer_;
  ros::SteadyTimer feedback_timer_;
  ros::SteadyTimer diagnostics_timer_;
  std::unique_ptr<Reconfigurable<NavigatePathConfig, NavigatePathOptions>> reconfigurable_;
};

}  // namespace grid_path_planner::nodes
