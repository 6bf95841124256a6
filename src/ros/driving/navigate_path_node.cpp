#include "ros/driving/navigate_path_node.h"

#include <geometry_msgs/PoseStamped.h>
#include <ros/callback_queue_interface.h>
#include <ros/console.h>
#include <std_msgs/Empty.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/current_error.h"
#include "grid_path_planner/NavigatePathConfig.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/driving/follow_log.h"
#include "ros/guard/guarded_queue.h"
#include "ros/guard/incoming/advertised_service.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/outgoing/latched_message.h"
#include "ros/guard/parameters.h"
#include "ros/guard/scheduling/guarded_timer.h"
#include "ros/guard/scheduling/log_throttle.h"
#include "ros/messages/vehicle_parameters.h"
#include "ros/messages/waypoint_reading.h"

namespace grid_path_planner::nodes {

using base::currentErrorText;
using base::InputError;
using base::StopSource;
using base::TaskQueue;
using following::DriveStatus;
using following::FollowEvent;
using following::FollowState;
using following::Join;
using path::Path;

namespace {

// Wall time
constexpr double kClockPeriod = 0.02;       // s
constexpr double kFeedbackPeriod = 0.2;     // s
constexpr double kDiagnosticsPeriod = 1.0;  // s

NavigatePathOptions loadOptions(const ros::NodeHandle& private_nh, const NodeFiles& files) {
  NavigatePathOptions options;
  loadParameters(private_nh, options);
  options.vehicle = loadVehicle(private_nh);
  if (options.require_vehicle && !options.vehicle)
    throw InputError("require_vehicle is set and no vehicle is described: " +
                     private_nh.resolveName("vehicle") + " is missing (doc/vehicle.md)");
  takeFromVehicle(options);
  options.config_filename = files.named("config_filename", options.config_filename);
  options.base_frame = frameName(options.base_frame);
  options.map_frame = frameName(options.map_frame);
  checkNavigatePathOptions(options);
  warnUnknownParameters(private_nh, withVehicleNames(optionNames<NavigatePathOptions>()));
  return options;
}

Path fileOf(const NavigatePathOptions& options, const NodeFiles& files) {
  return options.config_filename.empty() ? Path() : readWaypoints(files, options.config_filename);
}

Commands commandsOf(const ros::NodeHandle& nh, const NavigatePathOptions& options) {
  Commands commands;
  if (!options.share_cmd_vel) commands.topics = {nh.resolveName("cmd_vel")};
  commands.actions = {nh.resolveName("navigate_path")};
  commands.manual_control = nh.resolveName("manual_control");
  return commands;
}

// Beyond what a map may hold: in the frame of such a path no vehicle is driven.
bool isFar(const Eigen::Vector3d& position) {
  return position.cwiseAbs().maxCoeff() > path::kLargestCoordinate;
}

bool isFar(const Path& path) {
  return std::any_of(path.poses.begin(), path.poses.end(),
                     [](const path::Pose& pose) { return isFar(pose.position); });
}

bool isFar(const nav_msgs::Path& path) {
  return std::any_of(path.poses.begin(), path.poses.end(), [](const auto& stamped) {
    const geometry_msgs::Point& at = stamped.pose.position;
    return isFar({at.x, at.y, at.z});
  });
}

bool isDriven(FollowState state) {
  return state == FollowState::DRIVING || state == FollowState::PAUSED ||
         state == FollowState::BLOCKED;
}

}  // namespace

NavigatePathNode::NavigatePathNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh,
                                   const NodeFiles& files)
    : nh_(nh),
      files_(files),
      options_(loadOptions(private_nh, files)),
      file_(fileOf(options_, files)),
      commands_(private_nh.getNamespace(), commandsOf(nh_, options_)),
      transforms_(nh),
      time_(NodeTime::of(nh)),
      action_(nh, "navigate_path", false),
      diagnostics_(nh, private_nh, private_nh.getNamespace()) {
  waypoint_publisher_ = nh_.advertise<geometry_msgs::PoseStamped>("current_waypoint", 1, true);
  cancelled_publisher_ = nh_.advertise<std_msgs::Empty>("drive_cancelled", 1);
  loop_ = std::make_unique<DriveLoop>(nh_, options_, transforms_, loopCallbacks());
  map_ =
      std::make_unique<MapMonitor>(nh_, [this](const MapLiveness& life) { loop_->setMap(life); });
  limits_ = std::make_unique<SpeedLimitReceiver>(
      nh_, [this](const SpeedLimits& limits) { loop_->setSpeedLimits(limits); });
  reader_ = std::make_unique<TaskQueue>(
      [](const std::string& error) { tellGivenUp("A file or question", error); });
  offerServices(private_nh);
  startAction();
  commands_.refuseSimultaneous();
  reconfigurable_ = std::make_unique<Reconfigurable<NavigatePathConfig, NavigatePathOptions>>(
      private_nh, options_, [this](const NavigatePathOptions& options) { use(options); });
  on_jump_back_ = time_.onJumpBack([this](double seconds) { timeWentBack(seconds); });
  startTimers();
}

NavigatePathNode::~NavigatePathNode() {
  on_jump_back_.reset();
  clock_timer_.stop();
  feedback_timer_.stop();
  diagnostics_timer_.stop();
  loop_->finish();
  takeLastReports();
  path_subscriber_.shutdown();
  for (ros::ServiceServer& service : services_) service.shutdown();
  reconfigurable_.reset();
  reader_.reset();
  map_.reset();
  limits_.reset();
  takeLastReports();
  loop_.reset();
  nh_.getCallbackQueue()->removeByID(reinterpret_cast<std::uint64_t>(this));
}

void NavigatePathNode::takeLastReports() noexcept {
  guarded("A report of the last drive", [this] { takeReports(); });
}

// What waits in the queue when a joystick takes over was given before that.
DriveLoop::Callbacks NavigatePathNode::loopCallbacks() {
  return {[this] { callLater([this] { takeReports(); }); },
          [this](unsigned handovers) {
            callLater([this, handovers] {
              handovers_ = std::max(handovers_, handovers);
              endWhatIsNotDriven(kTakenOver);
            });
          }};
}

void NavigatePathNode::offerServices(ros::NodeHandle& private_nh) {
  using std_srvs::Trigger;
  services_ = {
      advertiseService<Trigger>(private_nh, "pause",
                                [this](auto&, auto& r) { return answer(loop_->pause(), r); }),
      advertiseService<Trigger>(private_nh, "resume",
                                [this](auto&, auto& r) { return answer(loop_->resume(), r); }),
      advertiseService<Trigger>(private_nh, "cancel",
                                [this](auto&, auto& r) { return answer(cancelByHand(), r); })};
}

void NavigatePathNode::startAction() {
  action_.registerGoalCallback([this] { onGoal(); });
  action_.registerPreemptCallback([this] { onPreempt(); });
  action_.start();
}

void NavigatePathNode::startTimers() {
  diagnostics_.setHardwareID("none");
  diagnostics_.add("path following", this, &NavigatePathNode::diagnose);
  diagnostics_.add("map", this, &NavigatePathNode::diagnoseMap);
  diagnostics_.add("vehicle", this, &NavigatePathNode::diagnoseVehicle);
  diagnostics_.add("other nodes", this, &NavigatePathNode::diagnoseOthers);
  clock_timer_ = guardedTimer(nh_, kClockPeriod, [this] { waitForTime(); });
  feedback_timer_ = guardedTimer(nh_, kFeedbackPeriod, [this] { publishFeedback(); });
  // force_update: the updater's own clock is ROS time, which may jump back.
  diagnostics_timer_ =
      guardedTimer(nh_, kDiagnosticsPeriod, [this] { diagnostics_.force_update(); });
}

void NavigatePathNode::use(NavigatePathOptions options) {
  options.base_frame = frameName(options.base_frame);
  options.map_frame = frameName(options.map_frame);
  options.vehicle = options_.vehicle;
  takeFromVehicle(options);
  checkNavigatePathOptions(options);
  if (options.config_filename != options_.config_filename)
    throw InputError("config_filename cannot be changed while the node runs: use the action");
  if (options.share_cmd_vel != options_.share_cmd_vel)
    throw InputError("share_cmd_vel cannot be changed while the node runs");
  loop_->setOptions(options);
  options_ = options;
}

// Only then is it known which paths are from before.
void NavigatePathNode::waitForTime() {
  if (!time_.isThere()) {
    waits_for_clock_ = true;
    return;
  }
  if (std::exchange(waits_for_clock_, false)) ROS_INFO("/clock is there");
  if (fileWaits()) return;
  clock_timer_.stop();
  startDriving();
}

// A drive that began while time went back is of a path from before, too.
void NavigatePathNode::timeWentBack(double seconds) {
  ROS_WARN_STREAM("ROS time went back by " << seconds
                                           << " s: tf is cleared and the drive cancelled");
  loop_->abandon("ROS time went back");
  endWhatIsNotDriven("ROS time went back");
  finished_goals_.timeWentBack();
}

void NavigatePathNode::startDriving() {
  // Of a driver that was there before.
  if (!options_.follow_latched) finished_goals_.endAllUntil(ros::Time::now());
  if (options_.config_filename.empty()) {
    path_subscriber_ = subscribeChecked<nav_msgs::Path>(
        nh_, "path", 1, [this](const nav_msgs::Path& path) { onPath(path); });
    return;
  }
  ROS_INFO_STREAM("Drives the waypoints of " << options_.config_filename);
  if (goal_active_) return;
  try {
    drive(file_, options_.join_nearest ? Join::NEAREST : Join::FIRST, handovers_);
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("The waypoints are refused: " << error.what());
  }
}

void NavigatePathNode::drive(const Path& path, Join join, unsigned handovers) {
  Placing by = placing();
  if (!isFar(path)) by.into = path.frame_id;
  try {
    drive_ = loop_->start(transforms_.place(path, by), join, handovers);
  } catch (const TransformError& error) {
    throw InputError(error.what());
  }
}

Placing NavigatePathNode::placing() const {
  return {options_.map_frame, options_.tf_timeout, Moving::WITH_VEHICLE, options_.base_frame,
          options_.zero_heading};
}

// In its own frame, so that no correction of the map's moves it; in the map's where that is as far away as utm.
Path NavigatePathNode::pathOf(const nav_msgs::Path& message) const {
  Placing by = placing();
  by.map_frame = options_.map_frame;
  if (!isFar(message)) by.into = frameInMap(message.header.frame_id, options_.map_frame);
  try {
    return transforms_.place(message, by);
  } catch (const TransformError& error) {
    throw InputError(error.what());
  }
}

// Of a file that is driven in the map's frame: whether tf does not lead there yet.
bool NavigatePathNode::fileWaits() {
  if (!isFar(file_)) return false;
  try {
    file_ = transforms_.place(file_, placing());
  } catch (const TransformError& error) {
    static LogThrottle seldom(10.0);
    ROS_WARN_STREAM_COND(seldom.isDue(), "The waypoints of " << options_.config_filename
                                                             << " wait for tf: " << error.what());
    return true;
  } catch (const InputError&) {  // whoever drives it is told
  }
  return false;
}

void NavigatePathNode::onPath(const nav_msgs::Path& message) {
  const auto problem = time_.problemWith(message.header.stamp);
  if (!message.poses.empty() && problem && !options_.follow_latched) {
    ROS_WARN_STREAM("A path stamped " << message.header.stamp << " is not driven: " << *problem
                                      << " (~follow_latched drives it all the same)");
    return;
  }
  if (goal_active_) {
    ROS_WARN("A path is not driven: a goal of the action navigate_path is");
    finished_goals_.endAllUntil(ros::Time::now());
    return;
  }
  if (message.poses.empty()) {
    loop_->abandon("the path is empty: none was found");
    return;
  }
  if (finished_goals_.isOver(message)) {
    ROS_INFO("A path is not driven: its goal was reached or cancelled; give it again");
    return;
  }
  try {
    drive(pathOf(message), Join::NEAREST, handovers_);
    finished_goals_.drive(message);
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("The path is refused: " << error.what());
  }
}

void NavigatePathNode::onGoal() {
  if (goal_active_) replaceGoal();
  const auto goal = action_.acceptNewGoal();
  goal_active_ = true;
  ++goals_;
  if (goal->path.poses.empty() && !goal->filename.empty()) {
    readGoal(goal->filename);
  } else {
    startGoal(
        [&] {
          if (!goal->filename.empty())
            throw InputError("a goal must give a path or a filename, got both");
          if (goal->path.poses.empty())
            throw InputError("a goal must give a path of at least one waypoint, or a filename");
          return pathOf(goal->path);
        },
        Join::NEAREST, handovers_);
  }
  if (action_.isPreemptRequested()) onPreempt();
}

void NavigatePathNode::startGoal(const std::function<Path()>& read, Join join, unsigned handovers) {
  try {
    drive(read(), join, handovers);
    finished_goals_.endAllUntil(ros::Time::now());
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("The goal is refused: " << error.what());
    finishGoal(DriveStatus::INVALID_REQUEST, error.what(), loop_->standing());
  } catch (...) {
    finishGoal(DriveStatus::INVALID_REQUEST, "the goal was given up: " + currentErrorText(),
               loop_->standing());
  }
}

// In the reader's thread, and back.
void NavigatePathNode::readGoal(const std::string& filename) {
  goal_is_read_ = true;
  reader_->post([this, filename, number = goals_, handovers = handovers_](const StopSource& stop) {
    std::function<Path()> read;
    try {
      read = [path = readWaypoints(files_, filename, stop)] { return path; };
    } catch (const std::exception& error) {
      read = [what = std::string(error.what())]() -> Path { throw InputError(what); };
    }
    callLater([this, read, number, handovers] {
      if (!goal_active_ || number != goals_ || !std::exchange(goal_is_read_, false)) return;
      startGoal(read, options_.join_nearest ? Join::NEAREST : Join::FIRST, handovers);
    });
  });
}

// A pause, also one by a joystick, holds for the next goal, too, as it does where a goal is cancelled: that
// may be a client that has planned anew.
void NavigatePathNode::replaceGoal() {
  const std::string reason = "replaced by another goal";
  loop_->abandon(reason);
  takeReports();
  goal_is_read_ = false;
  if (goal_active_) finishGoal(DriveStatus::CANCELLED, reason, loop_->standing());
}

void NavigatePathNode::onPreempt() {
  if (action_.isNewGoalAvailable()) return;  // onGoal follows
  loop_->abandon("the goal was cancelled");
  endDrivesUntilNow("the goal was cancelled");
}

// Whoever plans for this drive, or is about to send another, hears of it too.
NavigatePathNode::Answer NavigatePathNode::cancelByHand() {
  const std::string reason = "asked for by ~cancel";
  cancelled_publisher_.publish(std_msgs::Empty());
  const Answer answer = loop_->cancel(reason);
  if (endDrivesUntilNow(reason)) return {true, "cancelled while its file was read"};
  return answer;
}

// Whether there was a goal whose file is still read.
bool NavigatePathNode::endDrivesUntilNow(const std::string& reason) {
  takeReports();
  return endWhatIsNotDriven(reason);
}

bool NavigatePathNode::answer(const Answer& answer, std_srvs::Trigger::Response& response) {
  response.success = answer.done;
  response.message = answer.message;
  ROS_INFO_STREAM(answer.message);
  return true;
}

void NavigatePathNode::takeReports() {
  for (const DriveReport& report : loop_->takeReports()) {
    if (report.waypoint) publishLatched(waypoint_publisher_, *report.waypoint);
    if (!report.note.empty()) ROS_WARN_STREAM(report.note);
    if (!report.event) continue;
    logEvent(*report.event);
    if (report.event->kind != FollowEvent::Kind::ENDED || report.drive != drive_) continue;
    if (report.standing.status == DriveStatus::ARRIVED) finished_goals_.end();
    if (report.standing.status == DriveStatus::POSE_JUMP && !goal_active_) rejoinFile();
    if (goal_active_ && !goal_is_read_)
      finishGoal(report.standing.status, report.standing.message, report.standing);
  }
}

// A file has no planner that would say how to go on from where the vehicle is now.
void NavigatePathNode::rejoinFile() {
  if (options_.config_filename.empty()) return;
  ROS_WARN_STREAM("The file is joined anew at its point nearest to the vehicle");
  try {
    drive(file_, Join::NEAREST, handovers_);
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("The waypoints are refused: " << error.what());
  }
}

// Whoever took the vehicle that stood still does not find it driving off when he lets it go.
// Returns whether there was a goal whose file is still read.
bool NavigatePathNode::endWhatIsNotDriven(const std::string& reason) {
  finished_goals_.endAllUntil(ros::Time::now());
  if (!std::exchange(goal_is_read_, false) || !goal_active_) return false;
  finishGoal(DriveStatus::CANCELLED, reason, loop_->standing());
  return true;
}

void NavigatePathNode::finishGoal(DriveStatus status, const std::string& message,
                                  const DriveStanding& standing) {
  NavigatePathResult result;
  result.status = toString(status);
  result.message = message;
  result.missed_waypoints.assign(standing.missed.begin(), standing.missed.end());
  result.position_error_m = standing.position_error;
  result.yaw_error_rad = standing.yaw_error;
  goal_active_ = false;
  if (status == DriveStatus::ARRIVED)
    action_.setSucceeded(result, message);
  else if (status == DriveStatus::CANCELLED && action_.isPreemptRequested())
    action_.setPreempted(result, message);
  else
    action_.setAborted(result, message);
}

void NavigatePathNode::publishFeedback() {
  takeReports();
  if (!goal_active_ || goal_is_read_) return;
  const DriveStanding standing = loop_->standing();
  if (!isDriven(standing.state))  // where there was no memory to report its end
    return finishGoal(standing.status, standing.message, standing);
  NavigatePathFeedback feedback;
  feedback.current_waypoint = static_cast<std::uint32_t>(standing.waypoint);
  feedback.distance_remaining_m = standing.distance_remaining;
  feedback.time_remaining_s = standing.time_remaining;
  feedback.state = toString(standing.state);
  feedback.obstructed = standing.obstructed;
  if (standing.state == FollowState::BLOCKED) feedback.message = standing.message;
  action_.publishFeedback(feedback);
}

void NavigatePathNode::callLater(std::function<void()> work) {
  nh_.getCallbackQueue()->addCallback(callbackOf(std::move(work)),
                                      reinterpret_cast<std::uint64_t>(this));
}

}  // namespace grid_path_planner::nodes
