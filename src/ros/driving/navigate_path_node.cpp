#include "ros/driving/navigate_path_node.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <ros/console.h>

#include <optional>
#include <sstream>
#include <utility>

#include "grid_path_planner/NavigatePathConfig.h"
#include "grid_path_planner/following/path_clearance_check.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/common/file_kinds.h"
#include "ros/common/parameters.h"

namespace grid_path_planner::nodes {

using base::BodyVelocity;
using base::InputError;
using following::firstOccupied;
using following::FollowEvent;
using following::FollowInput;
using following::FollowState;
using following::Join;
using following::PathFollower;
using path::Path;
using path::readWaypointFile;

namespace {

constexpr double kFeedbackPeriod = 0.2;     // s, wall time
constexpr double kDiagnosticsPeriod = 1.0;  // s, wall time

NavigatePathOptions loadOptions(const ros::NodeHandle& private_nh, const NodeFiles& files) {
  NavigatePathOptions options;
  loadParameters(private_nh, options);
  options.config_filename = files.named("config_filename", options.config_filename);
  checkNavigatePathOptions(options);
  warnUnknownParameters(private_nh, optionNames<NavigatePathOptions>());
  return options;
}

bool isWarning(FollowEvent::Kind kind) {
  return kind == FollowEvent::Kind::MISSED || kind == FollowEvent::Kind::RETRY ||
         kind == FollowEvent::Kind::BLOCKED;
}

}  // namespace

NavigatePathNode::NavigatePathNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                                   const NodeFiles& files)
    : nh_(nh),
      files_(files),
      options_(loadOptions(private_nh, files)),
      follower_(options_.follower),
      transforms_(nh),
      action_(nh, "navigate_path", false),
      diagnostics_(nh, private_nh, private_nh.getNamespace()) {
  if (!options_.config_filename.empty()) file_ = readWaypoints(options_.config_filename);
  velocity_publisher_ = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 10);
  waypoint_publisher_ = nh_.advertise<geometry_msgs::PoseStamped>("current_waypoint", 1, true);
  map_.start(nh_, [] {});  // read by every check of the path ahead

  using Request = std_srvs::Trigger::Request;
  using Response = std_srvs::Trigger::Response;
  services_ = {
      private_nh.advertiseService<Request, Response>(
          "pause", [this](Request&, Response& r) { return answer(follower_.pause(), r); }),
      private_nh.advertiseService<Request, Response>(
          "resume", [this](Request&, Response& r) { return answer(follower_.resume(), r); }),
      private_nh.advertiseService<Request, Response>("cancel", [this](Request&, Response& r) {
        return answer(follower_.cancel("asked for by ~cancel"), r);
      })};
  action_.registerGoalCallback([this] { onGoal(); });
  action_.registerPreemptCallback([this] { onPreempt(); });
  action_.start();

  diagnostics_.setHardwareID("none");
  diagnostics_.add("path following", this, &NavigatePathNode::diagnose);
  reconfigurable_ = std::make_unique<Reconfigurable<NavigatePathConfig, NavigatePathOptions>>(
      private_nh, options_, [this](const NavigatePathOptions& options) { use(options); });
  startTimer();
  feedback_timer_ =
      nh_.createSteadyTimer(ros::WallDuration(kFeedbackPeriod),
                            [this](const ros::SteadyTimerEvent&) { publishFeedback(); });
  // force_update: the updater's own clock is ROS time, which may jump back.
  diagnostics_timer_ =
      nh_.createSteadyTimer(ros::WallDuration(kDiagnosticsPeriod),
                            [this](const ros::SteadyTimerEvent&) { diagnostics_.force_update(); });
}

NavigatePathNode::~NavigatePathNode() {
  timer_.stop();
  feedback_timer_.stop();
  diagnostics_timer_.stop();
  follower_.cancel("navigate_path ends");
  stop();
  if (velocity_publisher_.getNumSubscribers() > 0)
    ros::WallDuration(0.1).sleep();  // roscpp sends in a thread of its own and says not when it has
}

void NavigatePathNode::use(const NavigatePathOptions& options) {
  checkNavigatePathOptions(options);
  if (options.config_filename != options_.config_filename)
    throw InputError("config_filename cannot be changed while the node runs: use the action");
  follower_.setOptions(options.follower);
  const bool other_rate = options.control_rate != options_.control_rate;
  options_ = options;
  if (other_rate) startTimer();
}

void NavigatePathNode::startTimer() {
  timer_ = nh_.createSteadyTimer(ros::WallDuration(1.0 / options_.control_rate),
                                 &NavigatePathNode::onTimer, this);
}

void NavigatePathNode::onTimer(const ros::SteadyTimerEvent&) {
  if (!clock_.hasTime()) {
    waits_for_clock_ = true;
    return;
  }
  if (std::exchange(waits_for_clock_, false)) ROS_INFO("/clock is there");
  const ros::Time now = ros::Time::now();
  if (now == now_) return;  // a clock that stands still
  if (started_.isZero()) startDriving(now);
  cancelOnTimeJump(now);
  now_ = now;
  control(now);
}

// Time that goes back: paths from before the jump are not of this time.
void NavigatePathNode::cancelOnTimeJump(const ros::Time& now) {
  const std::optional<double> back = clock_.jumpedBack(now);
  if (!back) return;
  ROS_WARN_STREAM("ROS time went back by " << *back << " s: tf is cleared and the drive cancelled");
  transforms_.clear();
  FollowInput without_pose;
  without_pose.time = now.toSec();
  publishVelocity(follower_.update(without_pose));  // cancels, since time went back
  reportEvents();
  started_ = now_ = now;
}

// Only now is it known which paths are from before.
void NavigatePathNode::startDriving(const ros::Time& now) {
  started_ = now;
  if (options_.config_filename.empty()) {
    path_subscriber_ = nh_.subscribe("path", 1, &NavigatePathNode::onPath, this);
    return;
  }
  ROS_INFO_STREAM("Drives the waypoints of " << options_.config_filename);
  if (!goal_active_) follower_.start(file_, options_.join_nearest ? Join::NEAREST : Join::FIRST);
}

void NavigatePathNode::control(const ros::Time& now) {
  FollowInput input;
  input.time = now.toSec();
  if (!follower_.path().empty()) findVehicle(now, input);
  if (options_.check_map)
    input.check = [this](const std::vector<Eigen::Vector3d>& ahead) { return whyOccupied(ahead); };
  publishVelocity(follower_.update(input));
  reportEvents();
  publishWaypoint(now);
}

void NavigatePathNode::findVehicle(const ros::Time& now, FollowInput& input) const {
  try {
    input.pose = transforms_.recentPoseOf(options_.base_frame, follower_.path().frame_id, now,
                                          options_.tf_timeout);
  } catch (const TransformError& error) {
    input.pose_problem = error.what();
  }
}

std::string NavigatePathNode::whyOccupied(const std::vector<Eigen::Vector3d>& ahead) const {
  const ReceivedMap map = map_.latest();
  if (!map.grid) return "";
  try {
    const auto points = transforms_.pointsIn(map.frame_id, follower_.path().frame_id, ahead);
    const auto cell =
        firstOccupied(*map.grid, options_.occupied_min, points, options_.check_radius);
    if (!cell) return "";
    const Eigen::Vector2d at = map.grid->geometry().centre(*cell);
    std::ostringstream text;
    text << "projected_map is occupied ahead, at x " << at.x() << ", y " << at.y() << " m";
    return text.str();
  } catch (const TransformError& error) {
    return std::string("projected_map cannot be compared with the path: ") + error.what();
  }
}

void NavigatePathNode::onPath(const nav_msgs::Path& message) {
  cancelOnTimeJump(ros::Time::now());
  if (message.header.stamp < started_ && !options_.follow_latched) {
    ROS_WARN_STREAM("A path stamped " << message.header.stamp << " is not driven: navigate_path "
                                      << "started at " << started_
                                      << " (~follow_latched drives it all the same)");
    return;
  }
  if (goal_active_) {
    ROS_WARN("A path is not driven: a goal of the action navigate_path is");
    return;
  }
  if (message.poses.empty()) {
    if (follower_.active()) follower_.cancel("the path is empty: none was found");
    stop();
    return;
  }
  try {
    follower_.start(transforms_.pathIn(message, options_.base_frame), Join::NEAREST);
    published_waypoint_ = -1;
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("The path is refused: " << error.what());
  }
}

void NavigatePathNode::onGoal() {
  if (goal_active_) follower_.cancel("replaced by another goal");
  reportEvents();
  const auto goal = action_.acceptNewGoal();
  goal_active_ = true;
  try {
    const bool from_file = goal->path.poses.empty();
    follower_.start(pathOf(*goal),
                    from_file && !options_.join_nearest ? Join::FIRST : Join::NEAREST);
    published_waypoint_ = -1;
    if (action_.isPreemptRequested()) onPreempt();
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("The goal is refused: " << error.what());
    finishGoal("INVALID_REQUEST", error.what());
  }
}

Path NavigatePathNode::readWaypoints(const std::string& filename) const {
  return files_.read("config_filename", filename, waypointFiles(), readWaypointFile);
}

Path NavigatePathNode::pathOf(const NavigatePathGoal& goal) const {
  if (!goal.path.poses.empty() && !goal.filename.empty())
    throw InputError("a goal must give a path or a filename, got both");
  if (!goal.path.poses.empty()) return transforms_.pathIn(goal.path, options_.base_frame);
  if (goal.filename.empty())
    throw InputError("a goal must give a path of at least one waypoint, or a filename");
  return readWaypoints(goal.filename);
}

void NavigatePathNode::onPreempt() {
  if (action_.isNewGoalAvailable()) return;  // onGoal follows
  follower_.cancel("the goal was cancelled");
  stop();
}

bool NavigatePathNode::answer(const PathFollower::Answer& answer,
                              std_srvs::Trigger::Response& response) {
  response.success = answer.done;
  response.message = answer.message;
  ROS_INFO_STREAM(answer.message);
  if (follower_.state() != FollowState::DRIVING) stop();
  return true;
}

// At once, not with the next tick.
void NavigatePathNode::stop() {
  publishVelocity({});
  reportEvents();
}

void NavigatePathNode::reportEvents() {
  for (const FollowEvent& event : follower_.takeEvents()) {
    if (event.kind == FollowEvent::Kind::REACHED)
      ROS_DEBUG_STREAM(event.message);
    else if (isWarning(event.kind))
      ROS_WARN_STREAM(event.message);
    else
      ROS_INFO_STREAM(event.message);
    if (event.kind == FollowEvent::Kind::ENDED && goal_active_)
      finishGoal(toString(follower_.status()), follower_.message());
  }
}

void NavigatePathNode::finishGoal(const std::string& status, const std::string& message) {
  NavigatePathResult result;
  result.status = status;
  result.message = message;
  result.missed_waypoints.assign(follower_.missedWaypoints().begin(),
                                 follower_.missedWaypoints().end());
  result.position_error_m = follower_.positionError();
  result.yaw_error_rad = follower_.yawError();
  goal_active_ = false;
  if (status == "ARRIVED")
    action_.setSucceeded(result, message);
  else if (status == "CANCELLED" && action_.isPreemptRequested())
    action_.setPreempted(result, message);
  else
    action_.setAborted(result, message);
}

void NavigatePathNode::publishVelocity(const BodyVelocity& velocity) {
  const bool driven = follower_.active() && follower_.state() != FollowState::PAUSED;
  if (!driven && velocity.isZero() && silent_) return;
  silent_ = !driven && velocity.isZero();
  geometry_msgs::Twist message;
  message.linear.x = velocity.surge;
  message.linear.y = velocity.sway;
  message.linear.z = velocity.heave;
  message.angular.z = velocity.yaw_rate;
  velocity_publisher_.publish(message);
}

void NavigatePathNode::publishWaypoint(const ros::Time& now) {
  const int current = follower_.currentWaypoint();
  if (!follower_.active() || current == published_waypoint_) return;
  published_waypoint_ = current;
  geometry_msgs::PoseStamped message;
  message.header.stamp = now;
  message.header.frame_id = follower_.path().frame_id;
  message.pose = poseToMessage(follower_.path().poses[static_cast<std::size_t>(current)]);
  waypoint_publisher_.publish(message);
}

void NavigatePathNode::publishFeedback() {
  if (!goal_active_) return;
  NavigatePathFeedback feedback;
  feedback.current_waypoint = static_cast<std::uint32_t>(follower_.currentWaypoint());
  feedback.distance_remaining_m = follower_.distanceRemaining();
  feedback.state = toString(follower_.state());
  action_.publishFeedback(feedback);
}

void NavigatePathNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const FollowState state = follower_.state();
  const bool warn = state == FollowState::BLOCKED || state == FollowState::FAILED;
  status.summary(
      warn ? diagnostic_msgs::DiagnosticStatus::WARN : diagnostic_msgs::DiagnosticStatus::OK,
      std::string(toString(state)) + ": " + follower_.message());
  status.add("waypoint", follower_.currentWaypoint() + 1);
  status.add("waypoints", follower_.path().poses.size());
  status.add("distance remaining (m)", follower_.distanceRemaining());
  status.add("missed waypoints", follower_.missedWaypoints().size());
}

}  // namespace grid_path_planner::nodes
