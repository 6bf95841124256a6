// The node `navigate_path`: drives a path, a waypoint file or the goals of an action.
//
//   subscribes  path             nav_msgs/Path; an empty one stops; not with ~config_filename
//               projected_map    nav_msgs/OccupancyGrid, with its updates and their heartbeat; the
//                                vehicle stops before occupied cells, and stands without a map
//               speed_limit      nav_msgs/OccupancyGrid; percent of max_speed that cells allow
//               tf               the vehicle's pose; the vehicle stops while the pose is not known
//               stop             std_msgs/Bool; zeros while it is true
//               manual_control   std_msgs/Bool; a joystick commands: the drive is paused
//               localization_status   std_msgs/String; "OK: ...": DEGRADED drives slowly for a while, LOST holds
//   publishes   cmd_vel          geometry_msgs/Twist in base_link
//               current_waypoint geometry_msgs/PoseStamped, latched; the waypoint that is driven to
//               drive_cancelled  std_msgs/Empty; by ~cancel
//               /diagnostics
//   services    ~pause, ~resume, ~cancel   std_srvs/Trigger
//   action      navigate_path    grid_path_planner/NavigatePathAction
//
// This class is the slow side: messages, services, action, logs. The velocity comes from DriveLoop,
// whose thread waits for none of that. Waypoint files are read in a third thread.
//
// Guaranteed: cmd_vel is zeroed on every orderly shutdown, and at once by ~pause and ~cancel; without
// a drive nothing is published, so that others may command the vehicle. A path that cannot be driven
// is refused with an error and the present drive goes on. A goal of the action has priority over
// `path`: paths received meanwhile are ignored with a warning. A path for a goal whose drive is over
// (arrived, or cancelled by somebody) is not driven. The rate follows the wall clock, the
// control ROS time, so that both may run at different speeds. ROS time that goes back clears tf and
// cancels the drive. The node does not start where another publishes cmd_vel (but a joystick, and
// with ~share_cmd_vel) or offers the action. Not guaranteed: a zero after SIGKILL: the vehicle
// itself must stop when commands cease.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/steady_timer.h>
#include <ros/subscriber.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/base/task_queue.h"
#include "ros/driving/drive_loop.h"
#include "ros/driving/map_monitor.h"
#include "ros/driving/navigate_path_options.h"
#include "ros/guard/master/command_claim.h"
#include "ros/guard/master/other_commanders.h"
#include "ros/guard/node_files.h"
#include "ros/guard/node_time.h"
#include "ros/input/finished_goals.h"
#include "ros/input/frame_lookup.h"
#include "ros/messages/navigate_path_action.h"

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
  // parameters that cannot be used, a waypoint file that cannot be read, and another node that
  // commands. All callbacks are served by the queue of `nh`, which must be one thread's.
  NavigatePathNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const NodeFiles& files = {});
  // Zeroes cmd_vel.
  ~NavigatePathNode();

  // Zeroes cmd_vel, and nothing is driven any more. Thread-safe.
  void stop() { loop_->finish(); }

 private:
  using Answer = following::PathFollower::Answer;

  DriveLoop::Callbacks loopCallbacks();
  void offerServices(ros::NodeHandle& private_nh);
  void startAction();
  void startTimers();
  void use(NavigatePathOptions options);
  void waitForTime();
  void startDriving();
  void timeWentBack(double seconds);
  // `handovers`: handovers_ when it was given. Throws InputError.
  void drive(const path::Path& path, following::Join join, unsigned handovers);

  void onPath(const nav_msgs::Path& message);
  Placing placing() const;
  path::Path pathOf(const nav_msgs::Path& message) const;
  bool fileWaits();
  void onGoal();
  void replaceGoal();
  void onPreempt();
  void startGoal(const std::function<path::Path()>& read, following::Join join, unsigned handovers);
  void readGoal(const std::string& filename);
  void rejoinFile();
  bool answer(const Answer& answer, std_srvs::Trigger::Response& response);
  Answer cancelByHand();
  bool endDrivesUntilNow(const std::string& reason);

  void takeReports();
  void takeLastReports() noexcept;
  bool endWhatIsNotDriven(const std::string& reason);
  void finishGoal(following::DriveStatus status, const std::string& message,
                  const DriveStanding& standing);
  void publishFeedback();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseMap(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseVehicle(diagnostic_updater::DiagnosticStatusWrapper& status);
  void diagnoseOthers(diagnostic_updater::DiagnosticStatusWrapper& status);
  void callLater(std::function<void()> work);

  ros::NodeHandle nh_;
  NodeFiles files_;
  NavigatePathOptions options_;
  path::Path file_;  // of config_filename
  const CommandClaim commands_;
  OtherCommanders others_{commands_};
  FrameTransforms transforms_;
  NodeTime& time_;
  bool waits_for_clock_ = false;
  bool goal_active_ = false;
  unsigned goals_ = 0;            // accepted so far
  bool goal_is_read_ = false;     // its file, still
  unsigned drive_ = 0;            // begun last
  unsigned handovers_ = 0;        // of the loop, as this queue has heard
  FinishedGoals finished_goals_;  // of the topic `path`
  std::unique_ptr<DriveLoop> loop_;
  std::unique_ptr<MapMonitor> map_;
  std::unique_ptr<SpeedLimitReceiver> limits_;

  ros::Publisher waypoint_publisher_, cancelled_publisher_;
  ros::Subscriber path_subscriber_;
  std::vector<ros::ServiceServer> services_;
  NavigatePathServer action_;
  diagnostic_updater::Updater diagnostics_;
  ros::SteadyTimer clock_timer_;  // until there is a time
  ros::SteadyTimer feedback_timer_;
  ros::SteadyTimer diagnostics_timer_;
  std::unique_ptr<Reconfigurable<NavigatePathConfig, NavigatePathOptions>> reconfigurable_;
  std::unique_ptr<base::TaskQueue> reader_;  // of waypoint files
  std::shared_ptr<void> on_jump_back_;
};

}  // namespace grid_path_planner::nodes
