// The node `go_to_pose`: goals of move_base's clients, planned by path_planner and driven by navigate_path.
//
//   action      move_base              move_base_msgs/MoveBaseAction, under the name ~action_name
//   subscribes  move_base_simple/goal  geometry_msgs/PoseStamped; becomes a goal of the action
//               manual_control         std_msgs/Bool; a joystick that takes over while nothing is driven yet aborts the goal
//               drive_cancelled        std_msgs/Empty; somebody cancelled at the driver: the goal is aborted
//               tf                     the vehicle's pose
//   publishes   go_to_status           grid_path_planner/GoToStatus, latched
//               go_to_path             nav_msgs/Path, latched; the one that is driven, empty without one
//               move_base/current_goal geometry_msgs/PoseStamped, latched
//               clear_scan             std_msgs/Empty, by the step of recovery of that name: map_layers obeys
//               /diagnostics
//   calls       plan_path, navigate_path   actions of the planner and the driver
//
// What to do next is decided by following::Navigator; this class carries it out.
//
// Guaranteed: a goal ends after the driver has said that it stopped, or is gone. A goal that cannot be used is rejected and
// the one before goes on; one that can replaces it, and the vehicle stops until there is a path to it. A goal in another
// frame is transformed once, when it comes. ROS time that goes back, and the end of the node, stop the vehicle. The node does not
// start where another offers the action. Not guaranteed: a stop after SIGKILL: the driver drives the path that it has to its
// end, unless the node is started again, which cancels it.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/steady_timer.h>
#include <ros/subscriber.h>

#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "following/go_to/navigator.h"
#include "grid_path_planner/GoToStatus.h"
#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/PlanPathAction.h"
#include "ros/driving/go_to_messages.h"
#include "ros/driving/go_to_pose_options.h"
#include "ros/driving/move_base_action.h"
#include "ros/gate/manual_control.h"
#include "ros/guard/action/action_caller.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/master/command_claim.h"
#include "ros/guard/node_time.h"
#include "ros/input/frame_lookup.h"

namespace grid_path_planner {
class GoToPoseConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class GoToPoseNode {
 public:
  // Throws InputError for parameters that cannot be used, and another node that offers the action. All callbacks are
  // served by the queue of `nh`, which must be one thread's.
  GoToPoseNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh);
  // Stops the vehicle.
  ~GoToPoseNode();

  // The same, in the thread that destroys it.
  void finish() {
    timer_.stop();
    diagnostics_timer_.stop();
    giveUp();
  }
  // The same, from any thread but the queue's.
  void stop() {
    doneWithin(1.0, *nh_.getCallbackQueue(), [this] { giveUp(); });
  }

 private:
  using Order = following::NavigatorOrder;

  struct Goal {
    MoveBaseGoal handle;
    geometry_msgs::PoseStamped asked;
    std::optional<std::chrono::steady_clock::time_point> waits_since;  // for its transform
    std::optional<geometry_msgs::PoseStamped> pose;  // in the map's frame; none until tf knows it
  };

  void giveUp();
  void startServer();
  void startTimers();
  void use(const GoToPoseOptions& options);

  void subscribe();
  void onSimpleGoal(const geometry_msgs::PoseStamped& message);
  void onGoal(MoveBaseGoal handle);
  void onCancel(const MoveBaseGoal& handle);
  void locate();

  void tick();
  void timeWentBack(double seconds);
  Placing placingInMap() const;
  void noteVehicle();
  void onPlan(const PlanPathResult& result);
  void onDriveFeedback(const NavigatePathFeedback& feedback);
  void onDriveEnd(const DriverAnswer& answer);

  void carryOutOrders();
  void carryOut(const Order& order);
  void askForPlan(double tolerance);
  void drive(path::Path path);
  void showNoPath();
  void end(Order::Kind kind, const std::string& sentence);
  void noteHandover();
  void abortAll(const std::string& reason);

  void publishFeedback(const ros::Time& now);
  void publishStatus();
  GoToStatus status() const;
  std::string stateName() const;
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  static double seconds() { return ros::Time::now().toSec(); }

  ros::NodeHandle nh_;
  GoToPoseOptions options_;
  const CommandClaim commands_;
  FrameTransforms transforms_;
  NodeTime& time_;
  following::Navigator navigator_;
  std::optional<Goal> goal_;
  std::string last_sentence_ = "no goal has come yet";
  geometry_msgs::PoseStamped last_pose_;  // of the present goal or the last
  std::optional<path::Pose> vehicle_;
  double distance_remaining_ = std::numeric_limits<double>::infinity();  // m
  double time_remaining_ = std::numeric_limits<double>::infinity();      // s
  ManualControl joystick_;
  unsigned simple_goals_ = 0;           // taken so far
  bool driver_heeds_joystick_ = false;  // it has begun with a drive, and not ended since
  bool carrying_out_ = false;
  bool finished_ = false;  // the node ends
  std::chrono::steady_clock::time_point told_;

  ros::Publisher status_publisher_, path_publisher_, current_goal_publisher_, goal_publisher_,
      clear_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  ActionCaller<PlanPathAction> planner_;
  ActionCaller<NavigatePathAction> driver_;
  std::unique_ptr<MoveBaseServer> server_;
  diagnostic_updater::Updater diagnostics_;
  ros::SteadyTimer timer_;
  ros::SteadyTimer diagnostics_timer_;
  std::unique_ptr<Reconfigurable<GoToPoseConfig, GoToPoseOptions>> reconfigurable_;
  std::shared_ptr<void> on_jump_back_;
};

}  // namespace grid_path_planner::nodes
